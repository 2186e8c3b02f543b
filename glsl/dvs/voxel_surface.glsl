#ifndef DVS_VOXEL_SURFACE_GLSL
#define DVS_VOXEL_SURFACE_GLSL
// The two sides of a voxel's surface. The front faces the averaged normal, the back away from it; without directional
// leaves there is the front only. Radiance volumes of two sides hold the back's behind the front's (z + resolution).
#include "lib/voxel_grid.glsl"
#include "dvs/voxel_volumes.glsl"

vec3 leaf_axis(int leaf) {
    vec3 axis = vec3(0.0);
    axis[leaf / 2] = (leaf & 1) == 0 ? 1.0 : -1.0;
    return axis;
}

// Which way the front faces, given the averaged normal: where normals cancel, along the first leaf's axis.
vec3 front_of(vec3 n, uint leaves) {
    float size = length(n);
    if (size > 0.05) return n / size;
    for (int leaf = 0; leaf < 6; ++leaf)
        if ((leaves & (1u << leaf)) != 0u) return leaf_axis(leaf);
    return vec3(0.0, 1.0, 0.0);
}
vec3 voxel_normal(ivec3 voxel) {
    return front_of(texelFetch(voxels_normal, voxel, 0).xyz, texelFetch(voxels_flags, voxel, 0).r >> 2);
}

// Whether a surface in the voxel faces away from its averaged normal.
bool voxel_has_back(ivec3 voxel, vec3 n) {
    uint leaves = texelFetch(voxels_flags, voxel, 0).r >> 2;
    for (int leaf = 0; leaf < 6; ++leaf)
        if ((leaves & (1u << leaf)) != 0u && dot(leaf_axis(leaf), n) < -0.01) return true;
    return false;
}

// How far the voxel's surface lies from its centre along its averaged normal (voxels): 0 where that is not known.
float surface_offset(ivec3 voxel) {
    float offset = texelFetch(voxels_normal, voxel, 0).a;
    return offset > 0.99 ? 0.0 : offset;
}

vec3 voxel_centre(ivec3 voxel, int grid_resolution) {
    float side = voxel_grid_side(grid_resolution);
    return voxel_grid_origin(side) + (vec3(voxel) + 0.5) * (side / float(grid_resolution));
}

#endif
