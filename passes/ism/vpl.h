#pragma once
// std430 mirror of glsl/ism/vpl.glsl.

#include <glm/glm.hpp>

namespace bounce {

/// A virtual point light.
struct Vpl {
    glm::vec3 position;
    float area; ///< m² of surface that it stands for
    glm::vec3 normal;
    float padding_a;
    glm::vec3 intensity; ///< W/sr along the normal
    float padding_b;
};
static_assert(sizeof(Vpl) == 48);

} // namespace bounce
