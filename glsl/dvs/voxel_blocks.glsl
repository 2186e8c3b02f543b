#ifndef DVS_VOXEL_BLOCKS_GLSL
#define DVS_VOXEL_BLOCKS_GLSL
// What blocks a ray that goes from voxel to voxel (voxel/traverse.glsl). A voxel blocks what its surface faces, so that a
// surface does not block what leaves it; where normals cancel it blocks all, and two-sided surfaces block from behind too,
// past the first voxels. Where voxels know their mean plane, it is the plane that blocks: who leaves the voxel in front of
// it goes on, and who starts behind it is not blocked near by.
#include "dvs/voxel_surface.glsl"
#include "voxel/cone_steps.glsl"

uniform usampler3D voxels_bricks; // 0: all 4³ voxels are empty

uniform float facing_threshold = 0.05; //! [0, 0.9] exact hits: a voxel blocks rays whose cosine to its normal is above this

uniform float plane_depth = 0.0; //! [-1, 1] (voxels) exact hits: depth behind a voxel's plane from which it blocks
uniform float plane_slack = 2.0; //! [0, 2] (voxels) exact hits: a ray that enters farther behind the plane passes

struct WalkState {
    bool front; // the ray meets the side that the normal of the last voxel asked faces
};

int empty_width(VoxelGrid grid, ivec3 voxel, vec3 direction, inout WalkState walk) {
    return texelFetch(voxels_bricks, voxel >> 2, 0).r == 0u ? 4 : 0;
}

bool voxel_blocks(VoxelGrid grid, ivec3 voxel, vec3 origin, vec3 direction, float t, float leaves, inout WalkState walk) {
    uint flags = texelFetch(voxels_flags, voxel, 0).r;
    if (flags == 0u) return false;
    // The averaged normal, and in a the plane's offset from the voxel's centre along it (1: the whole voxel blocks).
    vec4 surface = texelFetch(voxels_normal, voxel, 0);
    vec3 n = surface.xyz;
    float size = length(n), facing = -dot(n, direction);
    uint ways = flags >> 2;
    walk.front = dot(front_of(n, ways), direction) <= 0.0;
    bool faces = facing > facing_threshold * size;
    if (!faces) {
        if (t < 2.0) return false;
        faces = size < 0.3 || ((ways & (ways >> 1) & 21u) != 0u && facing < -facing_threshold * size);
    }
#ifdef CHOOSES_HITS
    if (hit == hit_voxel) return faces;
#endif
    if (!faces || surface.a > 0.99) return faces;
    vec3 start = origin - vec3(voxel) - 0.5; // from the voxel's centre
    float side = walk.front ? 1.0 : -1.0, plane = surface.a * size;
    if (side * (dot(n, start + leaves * direction) - plane) > -plane_depth * size) return false;
    if (t > 0.0 && side * (dot(n, start + t * direction) - plane) < -plane_slack * size) return false;
    return t >= 2.0 || side * (dot(n, start) - plane) > 0.0;
}

#include "voxel/traverse.glsl"

VoxelHit find_blocking_voxel(VoxelGrid grid, vec3 apex, vec3 direction, float from) {
    return traverse(grid, apex, direction, from, WalkState(false));
}

#endif
