#pragma once
// What a view of voxels as cubes should show: for each pixel the nearest box among all that are drawn, by testing every
// one.

#include "gpu_scene/frame_constants.h"
#include "voxel/voxel_grid.h"

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace bounce {

struct DrawnCube {
    glm::ivec3 voxel;
    glm::vec3 colour; ///< before its face is shaded
};

struct CubesVerdict {
    int hits = 0, wrong = 0;
};

/// `shown`: RGBA of the view, a the distance; `edges` must be 0. `grid` at its base level, `side` voxels at the mip.
inline CubesVerdict judge_cubes(const std::vector<float>& shown, glm::ivec2 size, const FrameConstants& c,
                                const VoxelGrid& grid, int side, const std::vector<DrawnCube>& cubes,
                                float tolerance = 2e-3f) {
    CubesVerdict verdict;
    float metres = grid.side / float(side);
    for (int i = 0; i < size.x * size.y; ++i) {
        glm::vec2 plane = (glm::vec2(i % size.x, i / size.x) + 0.5f) / glm::vec2(size) * 2.0f - 1.0f;
        glm::vec3 ray = glm::normalize(c.camera_forward +
                                       c.tan_half_vfov * (plane.x * c.aspect * c.camera_right - plane.y * c.camera_up));
        float nearest = 1e30f;
        glm::vec3 found(0);
        int axis = 0;
        for (const DrawnCube& cube : cubes) {
            glm::vec3 t0 = (grid.origin + metres * glm::vec3(cube.voxel) - c.camera_position) / ray;
            glm::vec3 t1 = (grid.origin + metres * glm::vec3(cube.voxel + 1) - c.camera_position) / ray;
            glm::vec3 in = glm::min(t0, t1), out = glm::max(t0, t1);
            float from = std::max({in.x, in.y, in.z}), to = std::min({out.x, out.y, out.z});
            if (from > to || from <= 0 || from >= nearest) continue;
            nearest = from, found = cube.colour;
            axis = from == in.x ? 0 : from == in.y ? 1 : 2;
        }
        bool hit = nearest < 1e30f;
        verdict.hits += hit;
        float told = shown[size_t(4 * i + 3)];
        bool same = hit ? std::abs(told - nearest) < 2e-3f * nearest : told == 0;
        if (same && hit) {
            float light = axis == 1 ? (ray.y < 0 ? 1.0f : 0.2f) : axis == 0 ? 0.6f : 0.4f;
            for (int k = 0; k < 3; ++k) {
                float wanted = light * found[k];
                same = same && std::abs(shown[size_t(4 * i + k)] - wanted) < tolerance * (1 + wanted);
            }
        }
        verdict.wrong += !same;
    }
    return verdict;
}

} // namespace bounce
