#include "scene/motion.h"

#include "scene/keyframes.h"

#include <algorithm>
#include <cmath>

namespace bounce {

namespace {

// --- When to look -------------------------------------------------------------------------------------------------

constexpr float k_turn = 0.05f; // radians between samples of a rotation

size_t steps_between(const AnimationChannel& channel, size_t key) {
    if (channel.interpolation == Interpolation::step) return 1;
    if (channel.interpolation == Interpolation::cubic_spline) return 16;
    if (channel.target != AnimationTarget::rotation) return 2;
    glm::vec4 a = channel.values[key], b = channel.values[key + 1];
    float cosine = std::abs(glm::dot(a, b)) / std::max(glm::length(a) * glm::length(b), 1e-20f);
    return 2 + size_t(2 * std::acos(std::min(cosine, 1.0f)) / k_turn);
}

void add_steps(std::vector<float>& times, float from, float to, size_t steps) {
    // The moment before a key is where a step, or the end of a loop, still shows the old value.
    for (size_t i = 0; i < steps; ++i)
        times.push_back(from + (to - from) * (float(i) / float(steps)));
    times.push_back(std::nextafter(to, from));
    times.push_back(to);
}

/// Times of one cycle of every animation and of all paths. When animations of unequal length loop side by side, cycles
/// are added until the shared period, or 16 of the longest.
std::vector<float> sample_times(const Scene& scene, size_t most) {
    std::vector<float> times{0};
    float longest = 0;
    for (const Animation& animation : scene.animations)
        longest = std::max(longest, animation.duration);
    int repeats = 1;
    for (; repeats < 16; ++repeats) {
        bool shared = std::all_of(scene.animations.begin(), scene.animations.end(), [&](const Animation& animation) {
            float cycles = longest * float(repeats) / std::max(animation.duration, 1e-6f);
            return animation.duration <= 0 || std::abs(cycles - std::round(cycles)) < 1e-3f;
        });
        if (shared) break;
    }
    for (const Animation& animation : scene.animations) {
        if (animation.duration <= 0) continue;
        std::vector<float> cycle;
        for (const AnimationChannel& channel : animation.channels) {
            for (size_t k = 0; k + 1 < channel.times.size() && cycle.size() < 16 * most; ++k)
                add_steps(cycle, channel.times[k], channel.times[k + 1], steps_between(channel, k));
        }
        std::sort(cycle.begin(), cycle.end());
        cycle.erase(std::unique(cycle.begin(), cycle.end()), cycle.end());
        float horizon = longest * float(repeats);
        for (float start = 0; start < horizon && times.size() < 16 * most; start += animation.duration) {
            for (float t : cycle)
                times.push_back(start + t);
            times.push_back(std::nextafter(start + animation.duration, 0.0f));
        }
    }
    for (const Node& node : scene.nodes)
        for (size_t k = 0; k < node.path.keys.size() && times.size() < 32 * most; ++k) {
            const auto& keys = node.path.keys;
            if (k + 1 < keys.size())
                add_steps(times, keys[k].t, keys[k + 1].t, keys[k].has_target ? 64 : 2);
            else
                times.push_back(keys[k].t);
        }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.size() <= most) return times;
    std::vector<float> thinned;
    for (size_t i = 0; i < most; ++i)
        thinned.push_back(times[i * (times.size() - 1) / (most - 1)]);
    return thinned;
}

// --- What to look at ----------------------------------------------------------------------------------------------

std::array<glm::vec3, 8> corners_of(const Bounds& box) {
    std::array<glm::vec3, 8> out;
    for (int i = 0; i < 8; ++i)
        out[size_t(i)] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
    return out;
}

/// Its corners tell how far a path bows between two samples.
std::array<glm::vec3, 8> corners_of(const Mover& mover) {
    Bounds box;
    for (const glm::vec3& p : mover.points)
        box.add(p);
    return corners_of(box);
}

/// How far the path of any corner bows out of the straight line between two times, told by the middle.
float bow(const std::array<glm::vec3, 8>& corners, const glm::mat4& a, const glm::mat4& middle, const glm::mat4& b) {
    float most = 0;
    for (const glm::vec3& p : corners) {
        glm::vec3 off = world_point(middle, p) - 0.5f * (world_point(a, p) + world_point(b, p));
        most = std::max(most, glm::length(off));
    }
    return most;
}

/// Whether motion is continuous from a to b: they are more than a rounding apart, and no animation starts over.
bool smooth_between(const Scene& scene, float a, float middle, float b) {
    if (!(middle > std::nextafter(a, b) && middle < std::nextafter(b, a))) return false;
    return std::all_of(scene.animations.begin(), scene.animations.end(), [&](const Animation& animation) {
        float from = loop_time(animation, a), half = loop_time(animation, middle), to = loop_time(animation, b);
        return animation.duration <= 0 || (from <= half && half <= to);
    });
}

} // namespace

std::vector<glm::vec3> points_of(const Scene& scene, std::vector<uint32_t> used) {
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<glm::vec3> points;
    points.reserve(used.size());
    for (uint32_t index : used)
        points.push_back(scene.vertices[index].position);
    return points;
}

void visit_motion(const Scene& scene, std::vector<Mover>& movers, const MotionVisitor& visit) {
    size_t channels = 0, points = 0;
    for (const Animation& animation : scene.animations)
        channels += animation.channels.size();
    std::vector<std::array<glm::vec3, 8>> corners;
    for (const Mover& mover : movers) {
        corners.push_back(corners_of(mover));
        points += mover.points.size();
    }
    size_t most = std::clamp<size_t>(4'000'000 / (scene.nodes.size() + channels + 1), 64, 4096);
    std::vector<float> times = sample_times(scene, most);
    // Exact by every vertex where that is affordable; by the corners of the mesh's box otherwise, which is never too
    // small, and at most √3 times too large for a turned mesh.
    if (points * times.size() > 60'000'000)
        for (size_t i = 0; i < movers.size(); ++i)
            movers[i].points.assign(corners[i].begin(), corners[i].end());

    std::vector<glm::mat4> before = world_matrices(scene, 0);
    for (size_t i = 0; i < times.size(); ++i) {
        std::vector<glm::mat4> now = world_matrices(scene, times[i]);
        float middle = i ? 0.5f * (times[i - 1] + times[i]) : 0;
        bool between = i > 0 && smooth_between(scene, times[i - 1], middle, times[i]);
        std::vector<glm::mat4> halfway = between ? world_matrices(scene, middle) : now;
        for (size_t m = 0; m < movers.size(); ++m) {
            size_t node = movers[m].node;
            float margin = between ? bow(corners[m], before[node], halfway[node], now[node]) : 0;
            Bounds box;
            for (const glm::vec3& p : movers[m].points)
                box.add(world_point(now[node], p));
            visit(m, Bounds{box.min - margin, box.max + margin}, times.size());
        }
        before = std::move(now);
    }
}

} // namespace bounce
