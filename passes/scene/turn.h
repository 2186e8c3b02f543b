#pragma once
// Rotations as people give them: degrees about X, then Y, then Z of the world.

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace bounce {

glm::dquat rotation_of(const glm::dvec3& degrees);

/// Angles that make the rotation up to rounding: y is within ±90, x and z within ±180.
glm::dvec3 angles_of(const glm::dquat& rotation);

/// The unit quaternion nearest to `rotation` that is not changed when it is normalized again: what is written to a
/// file then reads back as the same bits.
glm::dquat settled(glm::dquat rotation);

/// The shortest turn that brings one direction to another; both of length 1.
glm::dquat turn_between(const glm::dvec3& from, const glm::dvec3& to);

} // namespace bounce
