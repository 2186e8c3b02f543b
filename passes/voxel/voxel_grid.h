#pragma once
// The voxel grid of the ground rules, on the CPU. glsl/lib/voxel_grid.glsl mirrors this file.

#include "scene/scene.h"

#include <algorithm>

namespace bounce {

/// A cube of resolution³ voxels centred on the scene's bounds over its whole animation.
struct VoxelGrid {
    glm::vec3 origin{0}; ///< world, metres: the corner of voxel (0, 0, 0)
    float side = 1;      ///< metres
    int resolution = 1;  ///< voxels along each axis

    VoxelGrid(const Bounds& bounds, int voxels) : resolution(voxels) {
        glm::vec3 edge = bounds.empty() ? glm::vec3(0) : bounds.size();
        side = std::max({edge.x, edge.y, edge.z, 1e-6f}) * (1 + 2 / float(voxels));
        origin = (bounds.empty() ? glm::vec3(0) : bounds.centre()) - 0.5f * side;
    }
    float voxel_size() const { return side / float(resolution); } ///< metres
    /// World → voxel units, 0 … resolution inside the grid.
    glm::vec3 to_voxel(glm::vec3 position) const { return (position - origin) * (float(resolution) / side); }
};

} // namespace bounce
