#ifndef DVS_FIXED_POINT_GLSL
#define DVS_FIXED_POINT_GLSL
// Sums of fragments as integers, whose order does not matter.
const uint k_sums = 13u; // a voxel: fragments, albedo, normal, emission, leaves, the plane's offset, the area of what emits
const float k_fixed = 32767.0;

uvec3 fixed_share(vec3 v) {
    return uvec3(round(clamp(v, vec3(0.0), vec3(1.0)) * k_fixed));
}
// Two's complement: sums of it wrap to the sum.
uvec3 fixed_normal(vec3 v) {
    return uvec3(ivec3(round(clamp(v, vec3(-1.0), vec3(1.0)) * k_fixed)));
}

uint fixed_offset(float offset) {
    return uint(int(round(clamp(offset, -1.0, 1.0) * k_fixed)));
}
// Of a fragment, times the area that it covers if that is how emission counts.
uvec3 fixed_emission(vec3 share, float weight) {
    return uvec3(round(clamp(share, vec3(0.0), vec3(1.0)) * (k_fixed * weight)));
}
uint fixed_area(float area) {
    return uint(round(area * k_fixed));
}

#endif
