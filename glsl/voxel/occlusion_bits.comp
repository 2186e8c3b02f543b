// Occlusion voxels of one bit each, without atomics: a byte holds a brick of 2×2×2 voxels, and the scene is gone through
// eight times, once for each place in the brick. In round k a byte may only gain bit k, so whatever a concurrent reader
// finds, old | (1 << k) is the same value: all writers of a byte write the same.
layout(FORMAT_voxels_bricks) coherent uniform uimage3D voxels_bricks; //! ordered: all writers of a byte write the same

uniform int iteration; // the round: x + 2·y + 4·z of the place in the brick

void store_brick(ivec3 voxel) {
    ivec3 brick = voxel >> 1;
    uint old = imageLoad(voxels_bricks, brick).r;
    imageStore(voxels_bricks, brick, uvec4(old | (1u << iteration)));
}

#define STORE_VOXEL(voxel) store_brick(voxel)
#define STORED_SLICES(grid_resolution) (2 * imageSize(voxels_bricks).z)
#define SKIP_VOXEL(voxel) (((voxel.x & 1) | (voxel.y & 1) << 1 | (voxel.z & 1) << 2) != iteration)
#include "voxel/occlusion_store.glsl"
#include "voxel/triangle_voxels.glsl"

layout(local_size_x = 256) in;

void visit_voxel(VisitedTriangle triangle, ivec3 voxel) {
    store_occlusion(voxel, facing_of(triangle, corners_of(triangle)), (materials[triangle.material].flags & 1u) != 0u, resolution_of_grid);
}

void main() {
    visit_triangles();
}
