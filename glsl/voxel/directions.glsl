#ifndef VOXEL_DIRECTIONS_GLSL
#define VOXEL_DIRECTIONS_GLSL
// N directions over a hemisphere with the density cosθ/π: cosθ = √(1 − (i + part)/N), a golden angle apart. Neighbours take
// other ones.
#include "surface/sample_pattern.glsl"
#include "voxel/cone_set.glsl"

// In the frame of the normal (z).
vec3 direction_of(SamplePattern which, int i, int count) {
    return cone_of(k_cones_spiral, count, i, which.part, which.turn).xyz;
}

#endif
