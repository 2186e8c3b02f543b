#pragma once
// Values between keys.

#include "scene/scene.h"

namespace bounce {

/// The channel's value at `time` seconds (xyz, or a unit quaternion as xyzw): step, linear (rotations: slerp along the
/// shorter arc) or cubic Hermite, as glTF 2.0 appendix C; the first and last values hold outside the keys.
glm::vec4 sample_channel(const AnimationChannel& channel, float time);

/// `time` within one cycle of the animation: [0, duration).
float loop_time(const Animation& animation, float time);

/// The rotation that turns −Z (lights and cameras) or +Z (objects: a glTF asset's front) along `direction`, Y up.
glm::quat look_rotation(const glm::vec3& direction, bool negative_z);

/// The end of the last animation or path, seconds; 0 when nothing moves.
float animation_duration(const Scene& scene);

} // namespace bounce
