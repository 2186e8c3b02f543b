// Light of emissive surfaces, scattered once: E/π at each pixel from shadow rays toward points of them, drawn by power, and
// from what the gather's rays met (at the gather's resolution, where it is smooth); or alone, from shadow rays.
#include "lib/frame.glsl"
#include "traced/emitter_rays.glsl"
#include "traced/emitted_light.glsl"
#include "surface/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform bool alone = false; //! static no rays of a gather count what they meet of emitters
#if !alone
uniform sampler2D traced_emitted;
#endif
layout(FORMAT_traced_emitted_light) writeonly uniform image2D traced_emitted_light;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    StartPoint start;
    vec3 light = vec3(0.0);
    if (start_at(pixel, start)) {
        light = emitted_light(pixel, start, alone ? 0.0 : 1.0 / k_shadow_rays_each);
#ifdef HAS_traced_emitters
#if !alone
        light += upsampled(traced_emitted, pixel, 4).rgb;
#endif
#endif
    }
    imageStore(traced_emitted_light, pixel, vec4(min(light, vec3(65504.0)), 1.0));
}
