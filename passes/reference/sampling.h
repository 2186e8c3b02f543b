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
