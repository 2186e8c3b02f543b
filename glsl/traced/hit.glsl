#ifndef TRACED_HIT_GLSL
#define TRACED_HIT_GLSL
// What a ray met, and the scene's buffers that tell more of it.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#ifndef WITHOUT_LIGHTS // of whom a storage block less is asked
#define SCENE_LIGHTS   // for those who include this: lib/scene.glsl is read once
#endif
#include "lib/scene.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"

const uint k_nothing = 0xffffffffu;

struct TracedHit {
    float t;     // in lengths of the direction
    uint draw;   // k_nothing: none
    uint corner; // of the triangle: its first index in scene_indices
    vec2 uv;     // weights of its second and third corner
};

#endif
