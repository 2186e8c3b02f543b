#pragma once
// Which voxels the triangles of a scene overlap, in double precision: the 13 separating axes of triangle and box, each
// of unit length, so that the greatest gap along them is a distance in voxels. Shares no code with the renderer: not
// the voxel grid either.

#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace bounce {

/// The greatest gap between a triangle and the voxel [v, v + 1]³ along any separating axis, in voxels; below 0: they
/// overlap, and that is how deep.
inline double separation(const std::array<glm::dvec3, 3>& p, glm::ivec3 voxel) {
    glm::dvec3 centre = glm::dvec3(voxel) + 0.5;
    double gap = -std::numeric_limits<double>::infinity();
    auto along = [&](glm::dvec3 axis) {
        double size = glm::length(axis);
        if (size < 1e-12) return;
        axis /= size;
        double low = 1e300, high = -1e300;
        for (const glm::dvec3& corner : p) {
            low = std::min(low, glm::dot(corner - centre, axis));
            high = std::max(high, glm::dot(corner - centre, axis));
        }
        double reach = 0.5 * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        gap = std::max({gap, low - reach, -reach - high});
    };
    const glm::dvec3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    along(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (int axis = 0; axis < 3; ++axis) {
        along(units[axis]);
        for (size_t i = 0; i < 3; ++i)
            along(glm::cross(p[(i + 1) % 3] - p[i], units[axis]));
    }
    return gap;
}

/// For each voxel, and for each of the six leaves when `leaf_threshold` ≥ 0, the least separation from any triangle.
class OverlapOracle {
  public:
    OverlapOracle(const Scene& scene, int voxels, double leaf_threshold = -1)
        : resolution(voxels), leaves(leaf_threshold < 0 ? 1 : 6),
          separations(size_t(leaves) * size_t(voxels) * size_t(voxels) * size_t(voxels), 1e9) {
        SceneState state = evaluate_scene(scene, 0, 0);
        Bounds bounds = scene_bounds_over_animation(scene);
        glm::dvec3 edge = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
        side = std::max({edge.x, edge.y, edge.z}) * (1 + 2.0 / voxels);
        origin = 0.5 * (glm::dvec3(bounds.max) + glm::dvec3(bounds.min)) - 0.5 * side;
        for (const Instance& instance : state.instances) {
            bool both_sides = scene.materials[size_t(instance.primitive.material)].double_sided;
            for (uint32_t i = 0; i + 2 < instance.primitive.index_count; i += 3) {
                std::array<glm::dvec3, 3> p;
                glm::dvec3 authored(0);
                for (uint32_t k = 0; k < 3; ++k) {
                    const Vertex& vertex = scene.vertices[scene.indices[instance.primitive.first_index + i + k]];
                    glm::dvec4 world = glm::dmat4(instance.world) * glm::dvec4(glm::dvec3(vertex.position), 1);
                    p[k] = (glm::dvec3(world) - origin) * (double(voxels) / side);
                    authored += glm::inverse(glm::transpose(glm::dmat3(instance.world))) * glm::dvec3(vertex.normal);
                }
                glm::dvec3 facing = glm::cross(p[1] - p[0], p[2] - p[0]);
                if (glm::length(facing) < 1e-12) continue;
                facing = glm::normalize(facing) * (glm::dot(facing, authored) < 0 ? -1.0 : 1.0);
                add(p, facing, both_sides, leaf_threshold);
            }
        }
    }

    int resolution, leaves;
    double side; ///< metres
    glm::dvec3 origin;
    std::vector<double> separations; ///< as the texture lies: x, y, z, leaf

    glm::ivec3 voxel_of(size_t index) const {
        auto n = size_t(resolution);
        return {int(index % n), int(index / n % n), int(index / n / n % n)};
    }

  private:
    void add(const std::array<glm::dvec3, 3>& p, glm::dvec3 facing, bool both_sides, double leaf_threshold) {
        glm::ivec3 low = glm::ivec3(glm::floor(glm::min(p[0], glm::min(p[1], p[2])))) - 1;
        glm::ivec3 high = glm::ivec3(glm::floor(glm::max(p[0], glm::max(p[1], p[2])))) + 1;
        low = glm::max(low, glm::ivec3(0)), high = glm::min(high, glm::ivec3(resolution - 1));
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int x = low.x; x <= high.x; ++x) {
                    double gap = separation(p, {x, y, z});
                    for (int leaf = 0; leaf < leaves; ++leaf) {
                        double cosine = facing[leaf / 2] * (leaf % 2 ? -1 : 1);
                        if (both_sides) cosine = std::abs(cosine);
                        if (leaves == 6 && cosine <= leaf_threshold) continue;
                        auto n = size_t(resolution);
                        double& least = separations[((size_t(leaf) * n + size_t(z)) * n + size_t(y)) * n + size_t(x)];
                        least = std::min(least, gap);
                    }
                }
            }
        }
    }
};

/// Voxels against the oracle. Borderline: the separation is within k_border of 0, where rounding decides.
struct OverlapCount {
    static constexpr double k_border = 1e-3; ///< voxels; positions in float have 4e-6 at 64³, edges of slivers more
    int occupied = 0, borderline = 0;        ///< by the oracle
    int extra = 0, missing = 0, between = 0; ///< voxels set, unset, and neither 0 nor 1, against the oracle
    double missing_share() const { return occupied ? double(missing) / occupied : 0; }
};

/// `judged`: which voxels count; all when empty.
inline OverlapCount count_overlap(const OverlapOracle& oracle, const std::vector<float>& voxels,
                                  const std::function<bool(glm::ivec3)>& judged = {}) {
    OverlapCount count;
    for (size_t i = 0; i < oracle.separations.size(); ++i) {
        if (judged && !judged(oracle.voxel_of(i))) continue;
        double gap = oracle.separations[i];
        if (voxels[i] != 0 && voxels[i] != 1) ++count.between;
        if (std::abs(gap) < OverlapCount::k_border) {
            ++count.borderline;
        } else if (gap < 0) {
            ++count.occupied;
            if (voxels[i] == 0) ++count.missing;
        } else if (voxels[i] != 0) {
            ++count.extra;
        }
    }
    return count;
}

} // namespace bounce
