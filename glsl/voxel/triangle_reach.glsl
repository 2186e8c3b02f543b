#ifndef VOXEL_TRIANGLE_REACH_GLSL
#define VOXEL_TRIANGLE_REACH_GLSL
// How far from a surface triangles block a ray, metres: near by, or everywhere. Who includes this declares `hit` and
// `near_share`.
#include "lib/frame.glsl"

float triangle_reach() {
#if hit == hit_near_triangle
    return near_share * scene_diagonal;
#else
    return 3.0e38;
#endif
}

#endif
