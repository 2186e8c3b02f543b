#pragma once
// Emissive triangles, drawn by power (area times mean emission), a point uniformly on each.

#include "reference/geometry.h"
#include "reference/sampling.h"

namespace bounce {

class Emitters {
  public:
    Emitters() = default;
    explicit Emitters(const TraceGeometry& geometry);
    bool empty() const { return table_.empty(); }

    struct Sample {
        glm::vec3 position;  ///< moved off the triangle toward the lit point
        glm::vec3 direction; ///< from the lit point, unit
        glm::vec3 radiance{0};
        float density = 0; ///< per solid angle at the lit point; 0: nothing to add
    };
    Sample sample(const TraceGeometry& geometry, const Place& from, float choice, const glm::vec2& u) const;
    /// The density with which `sample` would have drawn the point where a ray from there hit, per solid angle.
    float density(const TraceGeometry& geometry, const Place& from, const Hit& hit,
                  const glm::vec3& ray_direction) const;

  private:
    struct Triangle {
        uint32_t geometry, triangle;
    };
    std::vector<Triangle> triangles_;
    std::vector<uint32_t> first_; ///< by geometry: index of its first triangle in the table; ~0 = not emissive
    WeightedTable table_;
};

} // namespace bounce
