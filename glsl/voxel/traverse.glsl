#ifndef VOXEL_TRAVERSE_GLSL
#define VOXEL_TRAVERSE_GLSL
// The first voxel that blocks a ray, exactly: from voxel to voxel (Amanatides and Woo 1987), and over empty cubes of voxels
// at once. What is empty and what blocks is defined before this file is included (dvs/voxel_blocks.glsl,
// voxel/exact_hit.glsl):
//   WalkState            what that keeps from voxel to voxel
//   int empty_width(VoxelGrid grid, ivec3 voxel, vec3 direction, inout WalkState walk)
//                        the width in voxels of an aligned cube around the voxel that is known to be empty; 0: none is
//   bool voxel_blocks(VoxelGrid grid, ivec3 voxel, vec3 origin, vec3 direction, float t, float leaves, inout WalkState walk)
//                        whether the ray is blocked in a voxel. All in voxel units: it is at origin + t·direction, enters at
//                        t and leaves at `leaves`
#include "voxel/cone_steps.glsl"

struct VoxelHit {
    ivec3 voxel;
    float t;      // where the ray enters it, metres; below 0: nothing blocks
    float leaves; // where it leaves it, metres
    WalkState walk;
};

// From `from` metres on.
VoxelHit traverse(VoxelGrid grid, vec3 apex, vec3 direction, float from, WalkState walk) {
    vec3 origin = (apex - grid.origin) / grid.voxel; // voxel units
    vec3 safe = mix(direction, vec3(1.0e-6), lessThan(abs(direction), vec3(1.0e-6)));
    vec3 inverse = 1.0 / safe, ahead = step(vec3(0.0), safe);
    float t = from / grid.voxel, end = reach * scene_diagonal / grid.voxel;
    for (int i = 0; i < 1024 && t < end; ++i) {
        ivec3 voxel = ivec3(floor(origin + t * safe));
        if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(grid.resolution)))) break;
        int width = empty_width(grid, voxel, direction, walk);
        ivec3 low = width > 0 ? voxel & ~(width - 1) : voxel;
        vec3 exits = (vec3(low) + float(max(width, 1)) * ahead - origin) * inverse;
        float leaves = min(exits.x, min(exits.y, exits.z));
        if (width == 0 && voxel_blocks(grid, voxel, origin, safe, t, leaves, walk))
            return VoxelHit(voxel, t * grid.voxel, leaves * grid.voxel, walk);
        t = max(leaves, t) + 1.0e-3;
    }
    return VoxelHit(ivec3(0), -1.0, -1.0, walk);
}

#endif
