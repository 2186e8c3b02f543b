#ifndef VOXEL_EXACT_HIT_GLSL
#define VOXEL_EXACT_HIT_GLSL
// Where a ray is blocked in occlusion voxels, from voxel to voxel instead of by a thin cone: once it is hit_threshold voxels
// deep in voxels that block, along the axis of a leaf that it faces (any axis in an isotropic volume, as it goes). A layer of
// voxels around a plane is one voxel deep along the plane's axis, and the plane lies in its middle on average: at ½, for
// every angle.
#include "voxel/cone.glsl"

uniform float hit_threshold = 0.5; //! [0.05, 0.99] occlusion that blocks the cone; exact_hits: the hit's depth in voxels

struct WalkState {
    float depth;  // in voxels that block, so far, without a gap
    float enters; // where the ray came into them; voxel units
    float hit;    // where they block
};


// 1 where the voxel blocks along a leaf.
float base_occlusion(VoxelGrid grid, ivec3 voxel, int leaf) {
    voxel.z += leaf * grid.resolution;
    return occlusion_is_bits() ? brick_bit(voxel) : texelFetch(voxels_occlusion, voxel, 0).r;
}

int facing_leaf(vec3 direction, int axis) {
    return 2 * axis + (direction[axis] > 0.0 ? 1 : 0); // a surface that faces −axis blocks what goes along +axis
}

// Occlusion of the aligned cube of 2^mip voxels around one, over all leaves that face the ray.
float cube_occlusion(VoxelGrid grid, ivec3 voxel, vec3 direction, int mip) {
    int finer = occlusion_is_bits() ? 1 : 0;
    ivec3 at = voxel >> mip;
    if (grid.leaves == 1) return texelFetch(voxels_occlusion, at, mip - finer).r;
    float sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        sum += texelFetch(voxels_occlusion, at + ivec3(0, 0, facing_leaf(direction, axis) * (grid.resolution >> mip)), mip - finer).r;
    return sum;
}

int empty_width(VoxelGrid grid, ivec3 voxel, vec3 direction, inout WalkState walk) {
    // In coarser mips than skip_mips a single voxel no longer shows.
    if (grid.skip_mips >= 4 && cube_occlusion(grid, voxel, direction, 4) <= 0.0) return walk.depth = 0.0, 16;
    if (grid.skip_mips >= 2 && cube_occlusion(grid, voxel, direction, 2) <= 0.0) return walk.depth = 0.0, 4;
    return 0;
}

bool voxel_blocks(VoxelGrid grid, ivec3 voxel, vec3 origin, vec3 direction, float t, float leaves, inout WalkState walk) {
    float rate = 0.0;
    if (grid.leaves == 1) {
        rate = base_occlusion(grid, voxel, 0) > 0.5 ? 1.0 : 0.0;
    } else {
        for (int axis = 0; axis < 3; ++axis)
            if (base_occlusion(grid, voxel, facing_leaf(direction, axis)) > 0.5) rate = max(rate, abs(direction[axis]));
    }
    if (rate <= 0.0) {
        walk.depth = 0.0;
        return false;
    }
    SEE_STEP(grid.origin + grid.voxel * (origin + t * direction), t * grid.voxel, grid.voxel, rate, 0.0);
    if (walk.depth <= 0.0) walk.enters = t;
    float before = walk.depth;
    walk.depth += max(leaves - t, 0.0) * rate;
    walk.hit = t + (hit_threshold - before) / rate;
    return walk.depth >= hit_threshold;
}

#include "voxel/traverse.glsl"

// Where voxels block a ray, in metres; t below 0: nowhere.
struct OccludedAt {
    float t;
    float enters; // where the ray comes into the voxels that block it
    float leaves; // where it leaves the last of them
};

// From `from` metres on.
OccludedAt find_exact_hit(VoxelGrid grid, vec3 apex, vec3 direction, float from) {
    VoxelHit hit = traverse(grid, apex, direction, from, WalkState(0.0, 0.0, 0.0));
    float at = hit.walk.hit;
#ifdef CHOOSES_HITS
    if (enters_voxels()) at = hit.walk.enters;
#endif
    return OccludedAt(hit.t < 0.0 ? -1.0 : at * grid.voxel, hit.walk.enters * grid.voxel, hit.leaves);
}

#endif
