#pragma once
// Punctual lights on the CPU (KHR_lights_punctual, its units read as radiometric ones). Mirrors glsl/lib/light.glsl.

#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace bounce {

/// The extension's own angular attenuation, from the cosine of the angle off the axis and those of the cones.
inline float spot_falloff(float cosine, float inner_cone_cos, float outer_cone_cos) {
    float scale = 1.0f / std::max(0.001f, inner_cone_cos - outer_cone_cos);
    float t = std::clamp((cosine - outer_cone_cos) * scale, 0.0f, 1.0f);
    return t * t;
}

/// The same for a light (1 for lights that are no spot); `to_point` is the unit direction from the light to the lit
/// point.
inline float spot_falloff(const Light& light, const glm::vec3& to_point) {
    if (light.type != LightType::spot) return 1.0f;
    return spot_falloff(glm::dot(light.direction, to_point), std::cos(light.inner_cone), std::cos(light.outer_cone));
}

/// The irradiance at normal incidence at x (W/m²) without occlusion; `l` becomes the unit direction from x to the
/// light.
inline glm::vec3 light_irradiance(const Light& light, const glm::vec3& x, glm::vec3& l) {
    if (light.type == LightType::directional) {
        l = -light.direction;
        return light.intensity;
    }
    glm::vec3 to_light = light.position - x;
    float distance_squared = std::max(glm::dot(to_light, to_light), 1.0e-20f);
    l = to_light / std::sqrt(distance_squared);
    return light.intensity * (spot_falloff(light, -l) / distance_squared);
}

} // namespace bounce
