#include "scene/scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace bounce {

glm::vec2 environment_uv(const glm::vec3& direction) {
    glm::vec3 d = glm::normalize(direction);
    return {std::atan2(d.z, d.x) / glm::two_pi<float>() + 0.5f,
            std::acos(glm::clamp(d.y, -1.0f, 1.0f)) / glm::pi<float>()};
}

} // namespace bounce
