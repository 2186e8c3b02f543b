// Light of emissive surfaces, scattered once: E/π at each pixel from shadow rays toward points of them, drawn by power, and
// from what the gather's rays met (at the gather's resolution, where it is smooth); or alone, from shadow rays.
#include "lib/frame.glsl"
#include "traced/emitter_light.glsl"
#include "surface/upsample.glsl"
#include "surface/start.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform bool alone = false; //! static no rays of a gather count what they meet of emitters
#if !alone
uniform sampler2D traced_emitted;
#endif
layout(FORMAT_traced_emitted_light) writeonly uniform image2D traced_emitted_light;

uniform int emitter_rays = 4; //! [1, 64] shadow rays per pixel
uniform bool vary = false;    //! other points in each frame, for accumulation

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    StartPoint start;
    vec3 light = vec3(0.0);
#ifdef HAS_traced_emitters
    if (start_at(pixel, start)) {
        TracedSurface own;
        own.position = start.position;
        own.offset = dot(start.origin - start.position, start.face);
        own.face = start.face;
        own.shading = start.normal;
        uint place = hash_combine(hash_combine(uint(pixel.x), uint(pixel.y)), vary ? uint(frame_index) + 1u : 0u);
        for (int i = 0; any_emitters() && i < emitter_rays; ++i) {
            PixelSampler chances = pixel_sampler(place, uint(i));
            vec3 l;
            light += emitter_light(own, alone ? 0.0 : 1.0 / k_shadow_rays_each, chances, l) / float(emitter_rays);
        }
#if !alone
        light += upsampled(traced_emitted, pixel, 4).rgb;
#endif
    }
#endif
    imageStore(traced_emitted_light, pixel, vec4(min(light, vec3(65504.0)), 1.0));
}
