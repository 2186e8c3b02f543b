#ifndef LIB_BRDF_GLSL
#define LIB_BRDF_GLSL
// The surface model of the ground rules: f(v, l) = w·rho / pi + D·V·F, where w = 1 in the plain sum, and 1 − F_d(v·h) with
// the dielectric's F_d in glTF 2.0's own model (appendix B, "Metal BRDF and Dielectric BRDF").
//   rho = base_colour·(1 − metallic),  F0 = mix(0.04, base_colour, metallic),  alpha = roughness²
//   D: GGX (Walter et al. 2007, Eq. 33);  V: height-correlated Smith visibility (Heitz 2014, Eq. 99, over 4·nl·nv);  F: Schlick 1994.
// All vectors are unit; v points to the viewer and l to the light; n faces the viewer. passes/scene/brdf.h mirrors this file.
// Nothing here subtracts nearly equal numbers, so two implementations in 32-bit floats agree to a relative 1e-4.

const float k_pi = 3.14159265358979;
const float k_smallest_alpha = 1.0e-3; // a perfect mirror has no density: alpha is clamped here
const float k_dielectric_f0 = 0.04;

float brdf_alpha(float roughness) {
    return max(roughness * roughness, k_smallest_alpha);
}

vec3 brdf_f0(vec3 base_colour, float metallic) {
    return mix(vec3(k_dielectric_f0), base_colour, metallic);
}

// rho / pi
vec3 brdf_diffuse(vec3 base_colour, float metallic) {
    return base_colour * ((1.0 - metallic) / k_pi);
}

// The density of microfacet normals at h. |n × h|² stands for 1 − (n·h)², which would cancel near the peak.
float ggx_density(vec3 n, vec3 h, float alpha) {
    float nh = dot(n, h);
    vec3 across = cross(n, h);
    float a2 = alpha * alpha;
    float d = nh * nh * a2 + dot(across, across);
    return a2 / (k_pi * d * d);
}

// G2 / (4·nl·nv)
float smith_visibility(float nl, float nv, float alpha) {
    float a2 = alpha * alpha;
    float to_viewer = nl * sqrt(nv * nv * (1.0 - a2) + a2);
    float to_light = nv * sqrt(nl * nl * (1.0 - a2) + a2);
    return 0.5 / (to_viewer + to_light);
}

// (1 − v·h)^5, with 1 − v·h = |v − h|²/2
float schlick_weight(vec3 v, vec3 h) {
    vec3 difference = v - h;
    float m = min(0.5 * dot(difference, difference), 1.0);
    return m * m * m * m * m;
}

// Appendix B's weight of the diffuse lobe: 1 − F(v·h) of the dielectric.
float fresnel_diffuse_weight(vec3 v, vec3 h) {
    return (1.0 - k_dielectric_f0) * (1.0 - schlick_weight(v, h));
}

// The microfacet lobe without the cosine; 0 where the light or the viewer is below the horizon.
vec3 brdf_specular(vec3 n, vec3 v, vec3 l, vec3 base_colour, float metallic, float roughness) {
    float nl = dot(n, l);
    float nv = dot(n, v);
    if (nl <= 0.0 || nv <= 0.0) return vec3(0.0);
    float alpha = brdf_alpha(roughness);
    vec3 h = normalize(v + l);
    vec3 f0 = brdf_f0(base_colour, metallic);
    vec3 fresnel = f0 + (1.0 - f0) * schlick_weight(v, h);
    return fresnel * (ggx_density(n, h, alpha) * smith_visibility(nl, nv, alpha));
}

// The shading normal turned toward the viewer. The surface's own (geometric) normal decides which side is seen, so that
// an interpolated normal that leans past the silhouette is not turned over. Without one, pass `shading` twice.
vec3 turn_toward_viewer(vec3 shading, vec3 geometric, vec3 v) {
    vec3 facing = dot(geometric, v) < 0.0 ? -geometric : geometric;
    return dot(shading, facing) < 0.0 ? -shading : shading;
}

#endif
