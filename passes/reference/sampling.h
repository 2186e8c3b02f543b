#pragma once
// Drawing directions and table entries, with their densities.

#include "scene/brdf.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace bounce {

/// Two unit vectors that make a right-handed basis with unit n (Duff et al. 2017).
struct Basis {
    glm::vec3 x, y, z;
    explicit Basis(const glm::vec3& n) : z(n) {
        float sign = std::copysign(1.0f, n.z);
        float a = -1.0f / (sign + n.z);
        float b = n.x * n.y * a;
        x = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    glm::vec3 to_world(const glm::vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    glm::vec3 to_local(const glm::vec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

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

/// Density cosθ/π about +z.
inline glm::vec3 cosine_hemisphere(const glm::vec2& u) {
    glm::vec2 d = concentric_disc(u);
    return {d.x, d.y, std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y))};
}

/// A cone about +z given by the squared sine of its half-angle (< 1), which does not cancel when it is narrow.
struct Cone {
    float one_minus_cos;
    explicit Cone(float sin_squared) : one_minus_cos(sin_squared / (1.0f + std::sqrt(1.0f - sin_squared))) {}
    float density() const { return 1.0f / (2.0f * k_pi * one_minus_cos); }
    /// Uniform over the cone's solid angle.
    glm::vec3 sample(const glm::vec2& u) const {
        glm::vec2 d = concentric_disc(u);
        // The disc's squared radius is uniform, so 1 − cosθ is too.
        float m = glm::dot(d, d) * one_minus_cos;
        float scale = std::sqrt(one_minus_cos * std::max(0.0f, 2.0f - m));
        return {d.x * scale, d.y * scale, 1.0f - m};
    }
};

/// A microfacet normal as seen from `v` (both in the surface's basis, v.z > 0): GGX's visible normals (Heitz 2018).
inline glm::vec3 visible_normal(const glm::vec3& v, float alpha, const glm::vec2& u) {
    glm::vec3 stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
    float length = stretched.x * stretched.x + stretched.y * stretched.y;
    glm::vec3 t1 = length > 0 ? glm::vec3(-stretched.y, stretched.x, 0) / std::sqrt(length) : glm::vec3(1, 0, 0);
    glm::vec3 t2 = glm::cross(stretched, t1);
    glm::vec2 d = concentric_disc(u);
    float s = 0.5f * (1.0f + stretched.z);
    d.y = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - d.x * d.x)) + s * d.y;
    glm::vec3 n = d.x * t1 + d.y * t2 + std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y)) * stretched;
    return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(1e-7f, n.z)));
}

/// The density of the direction that reflects v about a visible normal h: D·G₁/(4·nv), with nv divided out.
inline float visible_normal_density(float density_of_h, float nv, float alpha) {
    float a2 = alpha * alpha;
    return density_of_h * 0.5f / (nv + std::sqrt(a2 + (1.0f - a2) * nv * nv));
}

/// The power heuristic (Veach 1997) for the strategy of density `own`.
inline float mis_weight(float own, float other) {
    if (!(own < 1e18f)) return 1.0f;
    if (!(other < 1e18f)) return 0.0f;
    float a = own * own, b = other * other;
    return a + b > 0 ? a / (a + b) : 0.0f;
}

inline float luminance(const glm::vec3& c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

/// Draws entry i with probability weight_i / Σ weights. The running sum is in double, so that millions of entries add
/// up.
class WeightedTable {
  public:
    WeightedTable() = default;
    /// Negative and non-finite weights count as 0.
    explicit WeightedTable(const std::vector<float>& weights);
    bool empty() const { return !(total() > 0); }
    size_t size() const { return sums_.size(); }
    double total() const { return sums_.empty() ? 0 : sums_.back(); }
    float probability(size_t i) const { return float((sums_[i] - (i ? sums_[i - 1] : 0)) / sums_.back()); }
    /// `u` in [0,1) becomes the remaining random number within the entry.
    size_t draw(float& u) const;

  private:
    std::vector<double> sums_;
    std::vector<uint32_t> first_; ///< by equal steps of the running sum: where to start the search
};

} // namespace bounce
