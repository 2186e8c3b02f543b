#ifndef DVS_FIXED_POINT_GLSL
#define DVS_FIXED_POINT_GLSL
// Sums of fragments as integers, whose order does not matter.
const uint k_sums = 12u; // a voxel: fragments, albedo, normal, emission, leaves, spare
const float k_fixed = 32767.0;

uvec3 fixed_share(vec3 v) {
    return uvec3(round(clamp(v, vec3(0.0), vec3(1.0)) * k_fixed));
}
// Two's complement: sums of it wrap to the sum.
uvec3 fixed_normal(vec3 v) {
    return uvec3(ivec3(round(clamp(v, vec3(-1.0), vec3(1.0)) * k_fixed)));
}

#endif
