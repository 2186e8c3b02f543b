#ifndef TRACED_HIT_GLSL
#define TRACED_HIT_GLSL
// What a ray met. traced/scene.glsl has the buffers that tell more of it.
#include "lib/hash.glsl" // of rays, for blended surfaces

const uint k_nothing = 0xffffffffu;

struct TracedHit {
    float t;     // in lengths of the direction
    uint draw;   // k_nothing: none
    uint corner; // of the triangle: its first index in scene_indices
    vec2 uv;     // weights of its second and third corner
};

#endif
