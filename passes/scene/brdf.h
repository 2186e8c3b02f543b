#pragma once
// The surface model of the ground rules on the CPU: f(v, l) = w·rho / pi + D·V·F, where w = 1 in the plain sum, and
// 1 − F_d(v·h) with the dielectric's F_d in glTF 2.0's own model (appendix B, "Metal BRDF and Dielectric BRDF").
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

/// Appendix B's weight of the diffuse lobe: 1 − F(v·h) of the dielectric.
inline float fresnel_diffuse_weight(const glm::vec3& v, const glm::vec3& h) {
    return (1.0f - k_dielectric_f0) * (1.0f - schlick_weight(v, h));
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

/// Area-preserving map of the unit square to the unit disc (Shirley & Chiu 1997).
inline glm::vec2 concentric_disc(const glm::vec2& u) {
    glm::vec2 p = 2.0f * u - 1.0f;
    if (p.x == 0 && p.y == 0) return {0, 0};
    float radius, angle;
    if (std::abs(p.x) > std::abs(p.y)) {
        radius = p.x;
        angle = k_pi / 4 * (p.y / p.x);
    } else {
        radius = p.y;
        angle = k_pi / 2 - k_pi / 4 * (p.x / p.y);
    }
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

/// A microfacet normal as seen from `v` (both in the surface's basis, v.z > 0): GGX's visible normals (Heitz 2018).
/// `d` is uniform over the unit disc; its first coordinate is the one across v.
inline glm::vec3 visible_normal_of(const glm::vec3& v, float alpha, glm::vec2 d) {
    glm::vec3 stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
    float length = stretched.x * stretched.x + stretched.y * stretched.y;
    glm::vec3 t1 = length > 0 ? glm::vec3(-stretched.y, stretched.x, 0) / std::sqrt(length) : glm::vec3(1, 0, 0);
    glm::vec3 t2 = glm::cross(stretched, t1);
    float s = 0.5f * (1.0f + stretched.z);
    d.y = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - d.x * d.x)) + s * d.y;
    glm::vec3 n = d.x * t1 + d.y * t2 + std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y)) * stretched;
    return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(1e-7f, n.z)));
}
inline glm::vec3 visible_normal(const glm::vec3& v, float alpha, const glm::vec2& u) {
    return visible_normal_of(v, alpha, concentric_disc(u));
}

/// The density of the direction that reflects v about a visible normal h: D·G₁/(4·nv), with nv divided out.
inline float visible_normal_density(float density_of_h, float nv, float alpha) {
    float a2 = alpha * alpha;
    return density_of_h * 0.5f / (nv + std::sqrt(a2 + (1.0f - a2) * nv * nv));
}

/// The shading normal turned toward the viewer. The surface's own (geometric) normal decides which side is seen, so
/// that an interpolated normal that leans past the silhouette is not turned over.
inline glm::vec3 turn_toward_viewer(const glm::vec3& shading, const glm::vec3& geometric, const glm::vec3& v) {
    glm::vec3 facing = glm::dot(geometric, v) < 0.0f ? -geometric : geometric;
    return glm::dot(shading, facing) < 0.0f ? -shading : shading;
}

} // namespace bounce
