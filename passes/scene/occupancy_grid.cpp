#include "scene/occupancy_grid.h"

#include "scene/extent.h"

#include <algorithm>
#include <cmath>

namespace bounce {

/// The part of a convex polygon inside a box (Sutherland & Hodgman, "Reentrant polygon clipping", 1974).
static std::vector<glm::dvec3> clipped(std::vector<glm::dvec3> polygon, const Bounds& box) {
    for (int side = 0; side < 6 && !polygon.empty(); ++side) {
        int axis = side / 2;
        double sign = side % 2 ? 1 : -1, limit = side % 2 ? box.max[axis] : -double(box.min[axis]);
        std::vector<glm::dvec3> kept;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
            double a = limit - sign * from[axis], b = limit - sign * to[axis];
            if (a >= 0) kept.push_back(from);
            if ((a >= 0) != (b >= 0)) kept.push_back(from + (to - from) * (a / (a - b)));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

OccupancyGrid::OccupancyGrid(const Scene& scene, int resolution) : bounds_(scene_extent(scene, 0).bounds) {
    if (bounds_.empty()) bounds_ = {glm::vec3(0), glm::vec3(0)};
    glm::vec3 extent = bounds_.size();
    float longest = std::max({extent.x, extent.y, extent.z});
    cell_ = longest > 0 && std::isfinite(longest) ? longest / float(resolution) : 1.0f;
    for (int axis = 0; axis < 3; ++axis) {
        float cells = std::isfinite(extent[axis]) ? std::floor(extent[axis] / cell_) : 0;
        size_[axis] = std::clamp(int(cells) + 1, 1, resolution + 1);
    }
    size_t count = size_t(size_.x) * size_t(size_.y) * size_t(size_.z);
    normals_.assign(count, glm::vec3(0));
    occupied_.assign(count, 0);

    std::vector<glm::mat4> worlds = world_matrices(scene, 0);
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].mesh < 0) continue;
        glm::mat3 turn(worlds[n]);
        for (const Primitive& primitive : scene.meshes[size_t(scene.nodes[n].mesh)].primitives)
            for (uint32_t i = 0; i + 2 < primitive.index_count; i += 3) {
                glm::vec3 corners[3], normal(0);
                for (uint32_t k = 0; k < 3; ++k) {
                    const Vertex& v = scene.vertices[scene.indices[primitive.first_index + i + k]];
                    corners[k] = glm::vec3(worlds[n] * glm::vec4(v.position, 1));
                    normal += turn * v.normal;
                }
                add_inside(corners, normal);
            }
    }
}

int OccupancyGrid::cell_index(const glm::vec3& p) const {
    glm::vec3 at = (p - bounds_.min) / cell_;
    for (int axis = 0; axis < 3; ++axis)
        if (!(at[axis] >= 0 && at[axis] < float(size_[axis]))) return -1;
    return (int(at.z) * size_.y + int(at.y)) * size_.x + int(at.x);
}

bool OccupancyGrid::occupied(const glm::vec3& p) const {
    int index = cell_index(p);
    return index >= 0 && occupied_[size_t(index)];
}

/// A triangle that strays is cut off at the bounds first: samples are spread over all of a triangle.
void OccupancyGrid::add_inside(const glm::vec3 corners[3], const glm::vec3& normal) {
    Bounds box;
    for (int k = 0; k < 3; ++k)
        box.add(corners[k]);
    Bounds both = box;
    both.add(bounds_);
    if (both.min == bounds_.min && both.max == bounds_.max) return add_triangle(corners, normal);
    std::vector<glm::dvec3> polygon = clipped({corners[0], corners[1], corners[2]}, bounds_);
    for (size_t i = 2; i < polygon.size(); ++i) {
        const glm::vec3 part[3] = {polygon[0], polygon[i - 1], polygon[i]};
        add_triangle(part, normal);
    }
}

void OccupancyGrid::add_triangle(const glm::vec3 corners[3], const glm::vec3& normal) {
    float longest = std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                              glm::distance(corners[2], corners[0])});
    if (!std::isfinite(longest)) return;
    int steps = std::clamp(int(std::ceil(2 * longest / cell_)), 1, 512);
    size_t points = size_t(steps + 1) * size_t(steps + 2) / 2;
    if (points > points_left_) steps = 2, points = 6;
    points_left_ -= std::min(points, points_left_);
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            float u = float(i) / float(steps), v = float(j) / float(steps);
            int index = cell_index(corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v);
            if (index < 0) continue;
            occupied_[size_t(index)] = 1;
            normals_[size_t(index)] += normal;
        }
}

OccupancyGrid::Hit OccupancyGrid::trace(const glm::vec3& origin, const glm::vec3& direction) const {
    float step = 0.5f * cell_;
    // The grid is small and so is the number of rays: half-cell steps will do.
    for (float t = 2 * cell_;; t += step) {
        int index = cell_index(origin + t * direction);
        if (index < 0) return {true, false, t};
        if (occupied_[size_t(index)]) return {false, glm::dot(normals_[size_t(index)], direction) < 0, t};
    }
}

} // namespace bounce
