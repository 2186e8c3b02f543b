#pragma once
// Rotations as people give them: degrees about X, then Y, then Z of the world.

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace bounce {

glm::dquat rotation_of(const glm::dvec3& degrees);

/// Angles that make the rotation up to rounding: y is within ±90, x and z within ±180.
glm::dvec3 angles_of(const glm::dquat& rotation);

/// `rotation` itself where its length is 1 but for rounding, so that what is written to a file reads back as the same
/// bits; else with its length made 1.
glm::dquat of_length_1(const glm::dquat& rotation);

/// The shortest turn that brings one direction to another; both of length 1.
glm::dquat turn_between(const glm::dvec3& from, const glm::dvec3& to);

} // namespace bounce
