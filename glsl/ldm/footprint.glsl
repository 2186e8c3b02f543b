#ifndef LDM_FOOTPRINT_GLSL
#define LDM_FOOTPRINT_GLSL
// What a photon's footprint gives to a surface point (LDM, Eq. 4 to 7): E_p·K(‖M(x − x_p)‖), with E_p = Φ/A, Silverman's
// kernel K(l) = 3/π·(1 − l²)² and
//   M = 2/(D_u·(D_v × n)) · [D_v × n; n × D_u; a·n].
// The first two rows map the ellipse inscribed in the footprint to the unit circle. The third weighs the distance off the
// footprint's plane; a is a length there, so it is given as 2·â·n/√A.
#include "lib/frame.glsl"
#include "ldm/photon.glsl"

#include "ldm/tiles.glsl"

// The pixel whose surface stands for a texel of that picture.
ivec2 splat_pixel(ivec2 texel) {
    ivec2 size = ivec2(splat_size);
    return min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
}

uniform float normal_agreement = 0.0; //! [0, 0.99] least cosine between a footprint's normal and that of a surface that it lights
uniform float plane_weight = 1.0; //! [0, 8] â: how fast a footprint ends off its plane (in half lengths √A/2)

vec3 footprint_normal(Photon photon) {
    return normalize(cross(photon.du.xyz, photon.dv.xyz));
}

// l² of Eq. 6.
float footprint_distance(Photon photon, vec3 n, vec3 x) {
    vec3 from = x - photon.position, du = photon.du.xyz, dv = photon.dv.xyz, across = cross(dv, n);
    vec3 l = 2.0 * vec3(dot(from, across), dot(from, cross(n, du)), 0.0) / dot(du, across);
    l.z = 2.0 * plane_weight * dot(from, n) / sqrt(photon.area);
    return dot(l, l);
}

// E_p·K, for the diffuse radiance ρ·ΣE_p·K (the BRDF's 1/π and Eq. 5's π cancel).
vec3 footprint_radiance(Photon photon, float distance_squared) {
    float k = 1.0 - distance_squared;
    return distance_squared < 1.0 ? photon.flux / photon.area * (3.0 / 3.14159265359 * k * k) : vec3(0.0);
}
#endif
