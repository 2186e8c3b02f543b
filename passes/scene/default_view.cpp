#include "scene/default_view.h"

#include "scene/extent.h"
#include "scene/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace bounce {

namespace {

constexpr int k_directions = 192;

/// Evenly spread directions (a Fibonacci spiral).
glm::vec3 spread_direction(int i) {
    float y = 1 - (2 * float(i) + 1) / float(k_directions);
    float r = std::sqrt(1 - y * y), phi = float(i) * 2.3999632f;
    return {r * std::cos(phi), y, r * std::sin(phi)};
}

/// What a point sees all around.
struct Surroundings {
    float front = 0;             ///< share of directions that meet a surface turned toward the point
    float open = 0;              ///< share that meets nothing
    float sky = 0;               ///< share of the upper half that meets nothing
    glm::vec3 open_direction{0}; ///< mean of the open directions: near length 1 when they lie close together
};

Surroundings look_around(const OccupancyGrid& grid, const glm::vec3& point) {
    Surroundings out;
    for (int i = 0; i < k_directions; ++i) {
        glm::vec3 direction = spread_direction(i);
        OccupancyGrid::Hit hit = grid.trace(point, direction);
        out.front += !hit.escaped && hit.front;
        out.open += hit.escaped;
        out.sky += hit.escaped && direction.y > 0;
        if (hit.escaped) out.open_direction += direction;
    }
    if (out.open > 0) out.open_direction /= out.open;
    out.front /= k_directions;
    out.open /= k_directions;
    out.sky /= 0.5f * k_directions;
    return out;
}

/// The mean over a few points around the middle: one of them may lie within a pillar, and in a fold of an object.
Surroundings look_from_middle(const OccupancyGrid& grid) {
    const glm::vec3 shares[] = {
        {0.5f, 0.5f, 0.5f}, {0.5f, 0.3f, 0.5f}, {0.35f, 0.6f, 0.6f}, {0.65f, 0.6f, 0.4f}, {0.5f, 0.7f, 0.5f}};
    Surroundings mean;
    int indoors = 0;
    for (const glm::vec3& share : shares) {
        Surroundings seen = look_around(grid, grid.bounds().min + share * grid.bounds().size());
        mean.front += seen.front / 5;
        mean.open += seen.open / 5;
        // A point above a low roof sees the sky and says nothing about the rooms below.
        if (seen.front > 0.5f) mean.sky += seen.sky, ++indoors;
        mean.open_direction += seen.open_direction * seen.open / 5.0f;
    }
    if (mean.open > 0) mean.open_direction /= mean.open;
    if (indoors > 0) mean.sky /= float(indoors);
    return mean;
}

glm::vec3 nearest_horizontal_axis(const glm::vec3& d) {
    if (std::abs(d.x) > std::abs(d.z)) return {d.x > 0 ? 1.0f : -1.0f, 0, 0};
    return {0, 0, d.z > 0 ? 1.0f : -1.0f};
}

/// Into the open side of a box: the side itself fills the picture.
Camera box_camera(const Bounds& bounds, const glm::vec3& toward_opening, float aspect) {
    Camera camera;
    camera.vfov = glm::radians(40.0f);
    glm::vec3 half = 0.5f * bounds.size();
    float width = std::abs(toward_opening.x) > 0.5f ? half.z : half.x;
    float depth = std::abs(toward_opening.x) > 0.5f ? half.x : half.z;
    float distance = 1.08f * std::max(half.y, width / aspect) / std::tan(0.5f * camera.vfov);
    camera.target = bounds.centre();
    camera.position = camera.target + toward_opening * (depth + distance);
    return camera;
}

/// How good a view is: how far it sees on the whole, less for things right in front of it, for what leaves the scene,
/// and for the backs of surfaces (which mean that it stands inside a wall).
float view_score(const OccupancyGrid& grid, const Camera& camera, float aspect) {
    glm::vec3 forward = glm::normalize(camera.target - camera.position);
    glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0))), up = glm::cross(right, forward);
    float tangent = std::tan(0.5f * camera.vfov), diagonal = grid.bounds().diagonal();
    constexpr int k_columns = 7, k_rows = 5;
    float score = 0;
    for (int y = 0; y < k_rows; ++y)
        for (int x = 0; x < k_columns; ++x) {
            float px = (2 * (float(x) + 0.5f) / k_columns - 1) * tangent * aspect;
            float py = (2 * (float(y) + 0.5f) / k_rows - 1) * tangent;
            OccupancyGrid::Hit hit = grid.trace(camera.position, glm::normalize(forward + px * right + py * up));
            float share = hit.distance / diagonal;
            if (!hit.escaped && !hit.front) share -= 0.25f;
            if (hit.escaped) share *= 0.5f;
            if (!hit.escaped && share < 0.04f) share -= 0.1f;
            score += share;
        }
    return score / (k_columns * k_rows);
}

/// Eye height above the floor: a person's in a building in metres, a third of the height otherwise.
float eye_height(float height) {
    return height > 2.2f && height < 200.0f ? 1.7f : 0.35f * height;
}

Camera inside_camera(const OccupancyGrid& grid, float aspect) {
    Bounds bounds = grid.bounds();
    glm::vec3 extent = bounds.size();
    Camera best;
    float best_score = -1e30f;
    constexpr int k_steps = 7, k_turns = 8;
    for (int i = 0; i < k_steps; ++i)
        for (int j = 0; j < k_steps; ++j) {
            auto share = [](int k) { return 0.12f + 0.76f * float(k) / (k_steps - 1); };
            glm::vec3 above = bounds.min + extent * glm::vec3(share(i), 0.45f, share(j));
            OccupancyGrid::Hit floor = grid.trace(above, {0, -1, 0});
            float ground = above.y - floor.distance;
            glm::vec3 eye(above.x, std::min(above.y, ground + eye_height(extent.y)), above.z);
            if (grid.occupied(eye)) continue;
            for (int turn = 0; turn < k_turns; ++turn) {
                float angle = glm::two_pi<float>() * float(turn) / k_turns;
                Camera camera;
                camera.vfov = glm::radians(60.0f);
                camera.position = eye;
                camera.target = eye + glm::vec3(std::cos(angle), 0.08f, std::sin(angle)) * (0.25f * bounds.diagonal());
                if (float score = view_score(grid, camera, aspect); score > best_score) {
                    best_score = score;
                    best = camera;
                }
            }
        }
    return best_score > -1e30f ? best
                               : framing_camera(bounds, glm::normalize(glm::vec3(-0.55f, -0.35f, -1)), 0.8f, aspect);
}

} // namespace

Camera framing_camera(const Bounds& bounds, const glm::vec3& direction, float vfov, float aspect) {
    Camera camera;
    camera.vfov = vfov;
    if (bounds.empty() || !std::isfinite(bounds.diagonal())) return camera;
    glm::vec3 right =
        glm::normalize(glm::cross(direction, std::abs(direction.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1)));
    glm::vec3 up = glm::cross(right, direction);
    float tangent = std::tan(0.5f * vfov), distance = 0;
    for (int i = 0; i < 8; ++i) {
        glm::vec3 side(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f);
        glm::vec3 corner = side * bounds.size();
        float across = std::max(std::abs(glm::dot(corner, right)) / aspect, std::abs(glm::dot(corner, up)));
        distance = std::max(distance, across / tangent - glm::dot(corner, direction));
    }
    camera.target = bounds.centre();
    camera.position = camera.target - direction * (distance > 0 ? 1.08f * distance : 1.0f);
    return camera;
}

DefaultView default_view(const Scene& scene, float aspect) {
    DefaultView view;
    Bounds bounds = scene_extent(scene, 0).bounds;
    glm::vec3 from_above = glm::normalize(glm::vec3(-0.55f, -0.35f, -1));
    view.camera = framing_camera(bounds, from_above, 0.8f, aspect);
    if (bounds.empty() || !std::isfinite(bounds.diagonal()) || bounds.diagonal() == 0) return view;

    OccupancyGrid grid(scene, 96);
    Surroundings seen = look_from_middle(grid);
    if (seen.front < 0.5f) return view;
    view.sky_share = seen.sky;
    bool one_opening = seen.open > 0.03f && seen.open < 0.4f && glm::length(seen.open_direction) > 0.6f;
    if (one_opening && std::abs(seen.open_direction.y) < 0.3f) {
        view.kind = ViewKind::open_box;
        view.camera = box_camera(bounds, nearest_horizontal_axis(seen.open_direction), aspect);
    } else {
        view.kind = ViewKind::inside;
        view.camera = inside_camera(grid, aspect);
    }
    return view;
}

} // namespace bounce
