#pragma once
// The surface model of the ground rules on the CPU: f(v, l) = rho / pi + D·V·F, a plain sum.
//   rho = base_colour·(1 − metallic),  F0 = mix(0.04, base_colour, metallic),  alpha = roughness²
//   D: GGX (Walter et al. 2007, Eq. 33);  V: height-correlated Smith visibility (Heitz 2014, Eq. 99, over 4·nl·nv);
//   F: Schlick 1994.
// All vectors are unit; v points to the viewer and l to the light; n faces the viewer. Mirrors glsl/lib/brdf.glsl line
// by line. Nothing here subtracts nearly equal numbers, so the two agree to a relative 1e-4.

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace bounce {

constexpr float k_pi = 3.14159265358979f;
constexpr float k_smallest_alpha = 1.0e-3f; ///< a perfect mirror has no density: alpha is clamped here
constexpr float k_dielectric_f0 = 0.04f;

inline float brdf_alpha(float roughness) {
    return std::max(roughness * roughness, k_smallest_alpha);
}

inline glm::vec3 brdf_f0(const glm::vec3& base_colour, float metallic) {
    return glm::mix(glm::vec3(k_dielectric_f0), base_colour, metallic);
}

/// rho / pi
inline glm::vec3 brdf_diffuse(const glm::vec3& base_colour, float metallic) {
    return base_colour * ((1.0f - metallic) / k_pi);
}

/// The density of microfacet normals at h. |n × h|² stands for 1 − (n·h)², which would cancel near the peak.
inline float ggx_density(const glm::vec3& n, const glm::vec3& h, float alpha) {
    float nh = glm::dot(n, h);
    glm::vec3 across = glm::cross(n, h);
    float a2 = alpha * alpha;
    float d = nh * nh * a2 + glm::dot(across, across);
    return a2 / (k_pi * d * d);
}

/// G2 / (4·nl·nv)
inline float smith_visibility(float nl, float nv, float alpha) {
    float a2 = alpha * alpha;
    float to_viewer = nl * std::sqrt(nv * nv * (1.0f - a2) + a2);
    float to_light = nv * std::sqrt(nl * nl * (1.0f - a2) + a2);
    return 0.5f / (to_viewer + to_light);
}

/// (1 − v·h)^5, with 1 − v·h = |v − h|²/2
inline float schlick_weight(const glm::vec3& v, const glm::vec3& h) {
    glm::vec3 difference = v - h;
    float m = std::min(0.5f * glm::dot(difference, difference), 1.0f);
    return m * m * m * m * m;
}

/// The microfacet lobe without the cosine; 0 where the light or the viewer is below the horizon.
inline glm::vec3 brdf_specular(const glm::vec3& n, const glm::vec3& v, const glm::vec3& l, const glm::vec3& base_colour,
                               float metallic, float roughness) {
    float nl = glm::dot(n, l);
    float nv = glm::dot(n, v);
    if (nl <= 0.0f || nv <= 0.0f) return glm::vec3(0.0f);
    float alpha = brdf_alpha(roughness);
    glm::vec3 h = glm::normalize(v + l);
    glm::vec3 f0 = brdf_f0(base_colour, metallic);
    glm::vec3 fresnel = f0 + (1.0f - f0) * schlick_weight(v, h);
    return fresnel * (ggx_density(n, h, alpha) * smith_visibility(nl, nv, alpha));
}

/// The shading normal turned toward the viewer. The surface's own (geometric) normal decides which side is seen, so
/// that an interpolated normal that leans past the silhouette is not turned over.
inline glm::vec3 turn_toward_viewer(const glm::vec3& shading, const glm::vec3& geometric, const glm::vec3& v) {
    glm::vec3 facing = glm::dot(geometric, v) < 0.0f ? -geometric : geometric;
    return glm::dot(shading, facing) < 0.0f ? -shading : shading;
}

} // namespace bounce
