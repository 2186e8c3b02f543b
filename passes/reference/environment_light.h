#pragma once
// What surrounds the scene, as light: constant, or a map drawn by luminance.

#include "reference/sampling.h"
#include "scene/scene.h"

namespace bounce {

class EnvironmentLight {
  public:
    EnvironmentLight() = default;
    explicit EnvironmentLight(const Environment& environment);

    bool present() const { return present_; }
    /// Whether directions are drawn from a map. A constant environment is sampled well enough by the surface's own
    /// lobes.
    bool sampled() const { return !table_.empty(); }
    /// Radiance from a direction (unit, pointing away from the scene). Maps are read bilinearly, wrapping around.
    glm::vec3 radiance(const glm::vec3& direction) const;
    /// A direction and its density per solid angle. Only when sampled().
    glm::vec3 sample(float choice, const glm::vec2& u, float& density) const;
    float density(const glm::vec3& direction) const;

  private:
    bool present_ = false;
    glm::vec3 radiance_{0};
    Image map_;
    WeightedTable table_; ///< over texels, row by row
};

} // namespace bounce
