#include "reference/punctual_lights.h"

#include <limits>

namespace bounce {

PunctualLights::PunctualLights(const std::vector<Light>& lights) {
    for (const Light& light : lights) {
        if (!light.enabled || !(luminance(light.intensity) > 0)) continue;
        lights_.push_back(light);
        any_soft_ = any_soft_ || soft(light);
    }
}

/// The cone that the light fills as seen from a point at the given squared distance. From (nearly) inside of a sphere,
/// the sphere counts as one that just does not reach the point.
static float sin_squared(const Light& light, float distance_squared) {
    if (light.type == LightType::directional) {
        float s = std::sin(std::min(light.angular_radius, 1.5f));
        return s * s;
    }
    return std::min(light.radius * light.radius / distance_squared, 0.99f);
}

PunctualLights::Sample PunctualLights::sample(size_t i, const glm::vec3& x, const glm::vec2& u) const {
    const Light& light = lights_[i];
    Sample sample;
    const glm::vec3 irradiance = light_irradiance(light, x, sample.direction);
    const bool directional = light.type == LightType::directional;
    const glm::vec3 to_light = light.position - x;
    const float distance_squared = glm::dot(to_light, to_light);
    sample.distance = directional ? std::numeric_limits<float>::infinity() : std::sqrt(distance_squared);
    sample.irradiance = irradiance;
    if (!soft(light)) return sample;

    const float s2 = sin_squared(light, distance_squared);
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

float PunctualLights::importance(size_t i, const glm::vec3& x) const {
    glm::vec3 l;
    return luminance(light_irradiance(lights_[i], x, l));
}

bool PunctualLights::meets(size_t i, const glm::vec3& origin, const glm::vec3& direction, float distance,
                           glm::vec3& radiance, float& density) const {
    const Light& light = lights_[i];
    if (!soft(light)) return false;
    glm::vec3 l;
    const glm::vec3 irradiance = light_irradiance(light, origin, l);
    const bool directional = light.type == LightType::directional;
    const glm::vec3 to_light = light.position - origin;
    const float distance_squared = glm::dot(to_light, to_light);
    const float s2 = sin_squared(light, distance_squared);
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
