#ifndef TRACED_EMITTER_RAYS_GLSL
#define TRACED_EMITTER_RAYS_GLSL
// Light of emissive triangles that triangles block.
#include "traced/emitter_light.glsl"
#include "traced/trace.glsl"

bool emitter_is_hidden(TracedSurface s, LightSample drawn, uint seed) {
    return trace_any(start_off(s), drawn.to_end, drawn.reach, seed);
}

#endif
