#ifndef LIB_VOXEL_GRID_GLSL
#define LIB_VOXEL_GRID_GLSL
// The voxel grid of the ground rules: a cube centred on the scene's bounds over its whole animation, without strays
// (passes/scene/extent.h). side = longest edge · (1 + 2/resolution), so that a layer of empty voxels lies around.
// passes/voxel/voxel_grid.h mirrors this file.
#include "lib/frame.glsl"

float voxel_grid_side(int grid_resolution) {
    vec3 edge = scene_max - scene_min;
    return max(max(edge.x, max(edge.y, edge.z)), 1.0e-6) * (1.0 + 2.0 / float(grid_resolution));
}

vec3 voxel_grid_origin(float side) {
    return 0.5 * (scene_min + scene_max) - 0.5 * side;
}

// World → voxel units, 0 … resolution inside the grid.
vec3 world_to_voxel(vec3 position, int grid_resolution) {
    float side = voxel_grid_side(grid_resolution);
    return (position - voxel_grid_origin(side)) * (float(grid_resolution) / side);
}

#endif
