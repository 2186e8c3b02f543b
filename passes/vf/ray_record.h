#pragma once
// What is kept of the rays of one texel of the low resolution. glsl/vf/ray_record.glsl mirrors it.

#include <glm/glm.hpp>

namespace bounce {

inline constexpr int k_max_recorded_rays = 64;

/// The buffer debug.fan, std430.
struct RecordedFan {
    glm::ivec2 texel; ///< of the low resolution; −1: no surface
    int rays;
    int padding;
    glm::vec4 origin;                   ///< xyz, metres
    glm::vec4 ray[k_max_recorded_rays]; ///< xyz: direction; w: metres to the disc that it meets, below 0: none
};

static_assert(sizeof(RecordedFan) == 32 + 16 * k_max_recorded_rays);

} // namespace bounce
