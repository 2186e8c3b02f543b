#pragma once
// The camera: right-handed look-at, vertical field of view, row 0 at the top. Mirrors glsl/lib/camera.glsl.

#include "scene/scene.h"

#include <cmath>

namespace bounce {

/// Columns: right, up, forward (unit). An `up` along the view falls back to another axis.
inline glm::mat3 camera_basis(const glm::vec3& position, const glm::vec3& target, const glm::vec3& up) {
    glm::vec3 forward = glm::normalize(target - position);
    glm::vec3 across = glm::cross(forward, up);
    if (glm::dot(across, across) < 1.0e-12f * glm::dot(up, up)) {
        across = glm::cross(forward, std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
    }
    glm::vec3 right = glm::normalize(across);
    return glm::mat3(right, glm::cross(right, forward), forward);
}

/// The unit direction through `pixel` (pixels, (0.5, 0.5) is the centre of the top left one) of an image of `size`.
inline glm::vec3 camera_ray(const glm::mat3& basis, float tan_half_vfov, const glm::vec2& size,
                            const glm::vec2& pixel) {
    glm::vec2 plane = glm::vec2(2.0f * pixel.x - size.x, size.y - 2.0f * pixel.y) * (tan_half_vfov / size.y);
    return glm::normalize(basis * glm::vec3(plane, 1.0f));
}

/// Where what the camera sees along a unit `direction` begins: on its near plane, if it has one.
inline glm::vec3 camera_ray_start(const Camera& camera, const glm::mat3& basis, const glm::vec3& direction) {
    if (!(camera.near_plane > 0)) return camera.position;
    return camera.position + direction * (camera.near_plane / glm::dot(direction, basis[2]));
}

} // namespace bounce
