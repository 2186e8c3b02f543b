#ifndef DVS_ATTENUATION_GLSL
#define DVS_ATTENUATION_GLSL
// DVS, Eq. 3–5: the cosines of a voxel's three dominant faces to the light, weighted by the squared components of its
// averaged normal N (as averaged: where normals disagree, N is short). `n` is N's direction, which says the faces.
float normal_weighted(vec3 averaged, vec3 n, vec3 l) {
    vec3 d = mix(max(-l, vec3(0.0)), max(l, vec3(0.0)), greaterThan(n, vec3(0.0))); // Eq. 4
    float squared = dot(averaged, averaged);
    vec3 w = squared > 0.0025 ? averaged * averaged : n * n;
    return dot(w, d); // Eq. 5
}
#endif
