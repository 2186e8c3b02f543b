#include "reference/punctual_lights.h"

#include <limits>

namespace bounce {

PunctualLights::PunctualLights(const std::vector<Light>& lights) {
    for (const Light& light : lights) {
        if (!light.enabled || !(luminance(light.intensity) > 0)) continue;
        const float sine = std::sin(std::clamp(light.angular_radius, 0.0f, 1.5f));
        lights_.push_back({light.type, light.position, light.direction, light.intensity, std::cos(light.inner_cone),
                           std::cos(light.outer_cone), light.radius, sine * sine});
        any_soft_ = any_soft_ || lights_.back().soft();
    }
}

/// light_irradiance of scene/light_falloff.h, with the cones' cosines at hand.
glm::vec3 PunctualLights::Prepared::irradiance(const Place& x, glm::vec3& l) const {
    if (directional()) {
        l = -direction;
        return intensity;
    }
    const glm::vec3 to_light = x.to(position);
    const float distance_squared = std::max(glm::dot(to_light, to_light), 1.0e-20f);
    l = to_light / std::sqrt(distance_squared);
    const float falloff =
        type == LightType::spot ? spot_falloff(-glm::dot(direction, l), inner_cone_cos, outer_cone_cos) : 1.0f;
    return intensity * (falloff / distance_squared);
}

/// The cone that the light fills as seen from a point at the given squared distance. From (nearly) inside of a sphere,
/// the sphere counts as one that just does not reach the point.
float PunctualLights::Prepared::cone_sin_squared(float distance_squared) const {
    return directional() ? sin_squared : std::min(radius * radius / distance_squared, 0.99f);
}

PunctualLights::Sample PunctualLights::sample(size_t i, const Place& x, const glm::vec2& u) const {
    const Prepared& light = lights_[i];
    Sample sample;
    const glm::vec3 irradiance = light.irradiance(x, sample.direction);
    const bool directional = light.directional();
    const glm::vec3 to_light = x.to(light.position);
    const float distance_squared = glm::dot(to_light, to_light);
    sample.distance = directional ? std::numeric_limits<float>::infinity() : std::sqrt(distance_squared);
    sample.irradiance = irradiance;
    if (!light.soft()) return sample;

    const float s2 = light.cone_sin_squared(distance_squared);
    const Cone cone(s2);
    const glm::vec3 local = cone.sample(u);
    if (!directional) {
        // The near side of the sphere along the drawn direction.
        const float sine_squared = std::max(0.0f, 1 - local.z * local.z);
        sample.distance *= local.z - std::sqrt(std::max(0.0f, s2 - sine_squared));
    }
    sample.direction = Basis(sample.direction).to_world(local);
    sample.density = cone.density();
    // Uniform radiance over the cone gives the irradiance E when it is E/(π·sin²).
    sample.irradiance = irradiance / (k_pi * s2 * sample.density);
    return sample;
}

float PunctualLights::importance(size_t i, const Place& x) const {
    glm::vec3 l;
    return luminance(lights_[i].irradiance(x, l));
}

bool PunctualLights::meets(size_t i, const Place& origin, const glm::vec3& direction, float distance,
                           glm::vec3& radiance, float& density) const {
    const Prepared& light = lights_[i];
    if (!light.soft()) return false;
    glm::vec3 l;
    const glm::vec3 irradiance = light.irradiance(origin, l);
    const bool directional = light.directional();
    const glm::vec3 to_light = origin.to(light.position);
    const float distance_squared = glm::dot(to_light, to_light);
    const float s2 = light.cone_sin_squared(distance_squared);
    const glm::vec3 across = glm::cross(l, direction);
    const float sine_squared = glm::dot(across, across);
    const float cosine = glm::dot(l, direction);
    if (cosine <= 0 || sine_squared >= s2) return false;
    const float reach = directional ? std::numeric_limits<float>::infinity()
                                    : std::sqrt(distance_squared) * (cosine - std::sqrt(s2 - sine_squared));
    if (directional ? distance < reach : distance <= reach) return false;
    radiance = irradiance / (k_pi * s2);
    density = Cone(s2).density();
    return true;
}

} // namespace bounce
