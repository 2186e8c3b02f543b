#include "scene/keyframes.h"

#include <algorithm>
#include <cmath>

namespace bounce {

namespace {

glm::vec4 unit_quaternion(const glm::vec4& q) {
    float length = glm::length(q);
    return length > 1e-12f ? q / length : glm::vec4(0, 0, 0, 1);
}

glm::vec4 slerp(const glm::vec4& from, const glm::vec4& to, float s) {
    glm::vec4 a = unit_quaternion(from), b = unit_quaternion(to);
    glm::quat q = glm::slerp(glm::quat(a.w, a.x, a.y, a.z), glm::quat(b.w, b.x, b.y, b.z), s);
    return {q.x, q.y, q.z, q.w};
}

/// Keys of a cubic spline are stored as in-tangent, value, out-tangent; tangents are per second.
glm::vec4 hermite(const AnimationChannel& channel, size_t key, float s, float interval) {
    const glm::vec4* values = channel.values.data() + 3 * key;
    const glm::vec4 &v0 = values[1], &out0 = values[2], &in1 = values[3], &v1 = values[4];
    float s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * v0 + interval * (s3 - 2 * s2 + s) * out0 + (-2 * s3 + 3 * s2) * v1 +
           interval * (s3 - s2) * in1;
}

} // namespace

glm::vec4 sample_channel(const AnimationChannel& channel, float time) {
    bool cubic = channel.interpolation == Interpolation::cubic_spline;
    bool rotation = channel.target == AnimationTarget::rotation;
    auto value = [&](size_t key) { return channel.values[cubic ? 3 * key + 1 : key]; };
    auto finish = [&](const glm::vec4& v) { return rotation ? unit_quaternion(v) : v; };

    size_t after = size_t(std::upper_bound(channel.times.begin(), channel.times.end(), time) - channel.times.begin());
    if (after == 0) return finish(value(0));
    size_t key = after - 1;
    if (after == channel.times.size() || channel.interpolation == Interpolation::step) return finish(value(key));
    float interval = channel.times[after] - channel.times[key];
    float s = (time - channel.times[key]) / interval;
    if (cubic) return finish(hermite(channel, key, s, interval));
    return rotation ? slerp(value(key), value(after), s) : glm::mix(value(key), value(after), s);
}

float loop_time(const Animation& animation, float time) {
    if (!(animation.duration > 0)) return 0;
    float t = std::fmod(time, animation.duration);
    return t < 0 ? t + animation.duration : t;
}

PathKey Path::at(float t) const {
    if (keys.empty()) return {};
    auto after =
        std::upper_bound(keys.begin(), keys.end(), t, [](float time, const PathKey& key) { return time < key.t; });
    PathKey out = after == keys.begin() ? keys.front() : *(after - 1);
    if (after != keys.begin() && after != keys.end()) {
        double s = (t - out.t) / (after->t - out.t);
        out.position = glm::mix(out.position, after->position, s);
        out.target = glm::mix(out.target, after->target, s);
        out.has_target = out.has_target && after->has_target;
    }
    out.t = t;
    return out;
}

glm::quat look_rotation(const glm::vec3& direction, bool negative_z) {
    float length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) return glm::quat(1, 0, 0, 0);
    glm::vec3 forward = direction / length;
    glm::vec3 up = std::abs(forward.y) < 0.9999f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    glm::vec3 z = negative_z ? -forward : forward;
    glm::vec3 x = glm::normalize(glm::cross(up, z));
    return glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(z, x), z)));
}

float animation_duration(const Scene& scene) {
    float end = 0;
    for (const Animation& animation : scene.animations)
        end = std::max(end, animation.duration);
    for (const Node& node : scene.nodes)
        if (!node.path.empty()) end = std::max(end, node.path.keys.back().t);
    return end;
}

} // namespace bounce
