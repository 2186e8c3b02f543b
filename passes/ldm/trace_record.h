#pragma once
// What is kept of the rays of one pixel. glsl/ldm/trace_record.glsl mirrors it.

#include <glm/glm.hpp>

namespace bounce {

/// The buffer debug.rays begins so, and goes on with a RecordedRay for each map. Both std430, 32 bytes.
struct TracedPixel {
    glm::vec3 x;      ///< metres
    int rays;         ///< 0: no surface
    glm::ivec2 pixel; ///< of the picture
    glm::ivec2 padding;
};

struct RecordedRay {
    glm::vec3 direction;
    float distance; ///< metres to what it meets; 1e30: nothing
    float cosine;   ///< to the normal; 0: the surface itself is in the way
    float padding[3];
};

static_assert(sizeof(TracedPixel) == 32 && sizeof(RecordedRay) == 32);

} // namespace bounce
