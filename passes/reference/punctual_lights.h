#pragma once
// Point, spot and directional lights, hard or with a radius. A light with a radius is a sphere (or, directional, a cone
// of directions) of uniform radiance whose unoccluded irradiance at normal incidence is that of the hard light:
// I·falloff/d², the spot's falloff taken at its centre. It is not seen by the camera and blocks no light.

#include "reference/geometry.h"
#include "reference/sampling.h"
#include "scene/light_falloff.h"

namespace bounce {

class PunctualLights {
  public:
    PunctualLights() = default;
    explicit PunctualLights(const std::vector<Light>& lights);
    bool empty() const { return lights_.empty(); }
    size_t size() const { return lights_.size(); }
    bool any_soft() const { return any_soft_; }

    struct Sample {
        glm::vec3 direction{0};  ///< unit, toward the light
        float distance = 0;      ///< to the light's point, infinite for directional lights
        glm::vec3 irradiance{0}; ///< at normal incidence, divided by the density of the sample
        float density = 0;       ///< per solid angle; 0 for a hard light, whose direction is the only one
    };
    /// Light i as seen from x.
    Sample sample(size_t i, const Place& x, const glm::vec2& u) const;
    /// Unoccluded irradiance at normal incidence from light i, by which one of many lights is chosen.
    float importance(size_t i, const Place& x) const;

    /// Calls add(i, radiance, density) for each soft light that a ray from `origin` meets before `distance`.
    template <class Add>
    void meet(const Place& origin, const glm::vec3& direction, float distance, Add&& add) const {
        for (size_t i = 0; any_soft_ && i < lights_.size(); ++i) {
            glm::vec3 radiance;
            float density;
            if (meets(i, origin, direction, distance, radiance, density)) add(i, radiance, density);
        }
    }

  private:
    struct Prepared {
        LightType type;
        glm::vec3 position, direction, intensity;
        float inner_cone_cos, outer_cone_cos;
        float radius;
        float sin_squared; ///< of the angular radius
        bool directional() const { return type == LightType::directional; }
        bool soft() const { return directional() ? sin_squared > 0 : radius > 0; }
        glm::vec3 irradiance(const Place& x, glm::vec3& l) const;
        float cone_sin_squared(float distance_squared) const;
    };
    bool meets(size_t i, const Place& origin, const glm::vec3& direction, float distance, glm::vec3& radiance,
               float& density) const;

    std::vector<Prepared> lights_;
    bool any_soft_ = false;
};

} // namespace bounce
