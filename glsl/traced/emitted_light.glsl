#ifndef TRACED_EMITTED_LIGHT_GLSL
#define TRACED_EMITTED_LIGHT_GLSL
// Light of emissive surfaces at a pixel, scattered once, from shadow rays toward points of them, drawn by power. Include
// what says what hides them (traced/emitter_light.glsl) before this file.
#include "surface/start.glsl"

uniform int emitter_rays = 4; //! [1, 64] shadow rays per pixel
uniform bool vary = false;    //! other points in each frame, for accumulation

// E/π. Of the gather's rays, which also meet emitters, there are `own_rays` for each shadow ray.
vec3 emitted_light(ivec2 pixel, StartPoint start, float own_rays) {
    vec3 light = vec3(0.0);
#ifdef HAS_traced_emitters
    TracedSurface own;
    own.position = start.position;
    own.offset = dot(start.origin - start.position, start.face);
    own.face = start.face;
    own.shading = start.normal;
    uint place = hash_combine(hash_combine(uint(pixel.x), uint(pixel.y)), vary ? uint(frame_index) + 1u : 0u);
    for (int i = 0; any_emitters() && i < emitter_rays; ++i) {
        PixelSampler chances = pixel_sampler(place, uint(i));
        vec3 l;
        light += emitter_light(own, own_rays, chances, l) / float(emitter_rays);
    }
#endif
    return light;
}

#endif
