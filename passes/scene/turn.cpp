#include "scene/turn.h"

#include <algorithm>
#include <cmath>

namespace bounce {

glm::dquat rotation_of(const glm::dvec3& degrees) {
    const glm::dvec3 angle = glm::radians(degrees);
    return glm::angleAxis(angle.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(angle.y, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(angle.x, glm::dvec3(1, 0, 0));
}

glm::dvec3 angles_of(const glm::dquat& rotation) {
    // Columns of Rz · Ry · Rx; column 0 is (cos y cos z, cos y sin z, −sin y).
    const glm::dmat3 m = glm::mat3_cast(glm::normalize(rotation));
    const double y = std::asin(std::clamp(-m[0].z, -1.0, 1.0));
    // Where X is turned onto Z, only the sum or difference of the other two counts: all of it is x's.
    const bool lost = std::abs(m[0].z) > 1 - 1e-12;
    const double x = lost ? std::atan2(-m[2].y, m[1].y) : std::atan2(m[1].z, m[2].z);
    const double z = lost ? 0 : std::atan2(m[0].y, m[0].x);
    return glm::degrees(glm::dvec3(x, y, z));
}

glm::dquat of_length_1(const glm::dquat& rotation) {
    return std::abs(glm::dot(rotation, rotation) - 1) < 1e-13 ? rotation : glm::normalize(rotation);
}

glm::dquat turn_between(const glm::dvec3& from, const glm::dvec3& to) {
    const double cosine = glm::dot(from, to);
    if (cosine < -1 + 1e-9) {
        // Half a turn, about anything at right angles.
        const glm::dvec3 other = std::abs(from.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        return glm::angleAxis(glm::radians(180.0), glm::normalize(glm::cross(from, other)));
    }
    const glm::dvec3 axis = glm::cross(from, to);
    return glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
}

} // namespace bounce
