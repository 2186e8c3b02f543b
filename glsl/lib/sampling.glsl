#ifndef LIB_SAMPLING_GLSL
#define LIB_SAMPLING_GLSL
// Drawing directions, with their densities. passes/reference/sampling.h and passes/scene/brdf.h mirror this file.
#include "lib/brdf.glsl"

// Area-preserving map of the unit square to the unit disc (Shirley & Chiu 1997).
vec2 concentric_disc(vec2 u) {
    vec2 p = 2.0 * u - 1.0;
    if (p.x == 0.0 && p.y == 0.0) return vec2(0.0);
    bool wide = abs(p.x) > abs(p.y);
    float radius = wide ? p.x : p.y;
    float angle = wide ? k_pi / 4.0 * (p.y / p.x) : k_pi / 2.0 - k_pi / 4.0 * (p.x / p.y);
    return radius * vec2(cos(angle), sin(angle));
}

// Density cosθ/π about +z.
vec3 cosine_hemisphere(vec2 u) {
    vec2 d = concentric_disc(u);
    return vec3(d, sqrt(max(0.0, 1.0 - dot(d, d))));
}

// A microfacet normal as seen from `v` (both in the surface's frame, v.z > 0): GGX's visible normals (Heitz 2018).
vec3 visible_normal(vec3 v, float alpha, vec2 u) {
    vec2 d = concentric_disc(u);
    vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
    float size = dot(stretched.xy, stretched.xy);
    vec3 t1 = size > 0.0 ? vec3(-stretched.y, stretched.x, 0.0) / sqrt(size) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(stretched, t1);
    float s = 0.5 * (1.0 + stretched.z);
    d.y = (1.0 - s) * sqrt(max(0.0, 1.0 - d.x * d.x)) + s * d.y;
    vec3 n = d.x * t1 + d.y * t2 + sqrt(max(0.0, 1.0 - dot(d, d))) * stretched;
    return normalize(vec3(alpha * n.xy, max(1.0e-7, n.z)));
}

// The density of the direction that reflects v about a visible normal: D·G₁/(4·nv), with nv divided out.
float visible_normal_density(float density_of_h, float nv, float alpha) {
    float a2 = alpha * alpha;
    return density_of_h * 0.5 / (nv + sqrt(a2 + (1.0 - a2) * nv * nv));
}

// A cone about +z, given by the squared sine of its half-angle (< 1).
float cone_one_minus_cos(float sine2) {
    return sine2 / (1.0 + sqrt(1.0 - sine2));
}
float cone_density(float sine2) {
    return 1.0 / (2.0 * k_pi * cone_one_minus_cos(sine2));
}
// Uniform over its solid angle.
vec3 cone_direction(float sine2, vec2 u) {
    vec2 d = concentric_disc(u);
    float m = dot(d, d) * cone_one_minus_cos(sine2);
    return vec3(d * sqrt(cone_one_minus_cos(sine2) * max(0.0, 2.0 - m)), 1.0 - m);
}

// The power heuristic (Veach 1997) for the strategy of density `own`.
float mis_weight(float own, float other) {
    if (!(own < 1.0e18)) return 1.0;
    if (!(other < 1.0e18)) return 0.0;
    float a = own * own, b = other * other;
    return a + b > 0.0 ? a / (a + b) : 0.0;
}

float luminance(vec3 c) {
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

#endif
