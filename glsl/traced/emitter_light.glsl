#ifndef TRACED_EMITTER_LIGHT_GLSL
#define TRACED_EMITTER_LIGHT_GLSL
// Light of emissive triangles at a surface by shadow rays toward drawn points, weighted against the rays of its diffuse
// lobe (Veach 1997). What is in the way, emitter_is_hidden says; whoever includes this file defines it, or includes
// traced/emitter_rays.glsl (triangles) or dvs/emitter_shadow.glsl (voxels).
#include "lib/sampling.glsl"
#include "traced/light_tables.glsl"
#include "lib/sampler.glsl"

// At the visible surface: shadow rays for each ray of the gather, as the weights take it (any number is right).
const float k_shadow_rays_each = 0.25;

float largest(vec3 v) {
    return max(v.r, max(v.g, v.b));
}

// Whether anything lies between the surface and the point that was drawn. `seed`: of draws for blended surfaces.
bool emitter_is_hidden(TracedSurface s, LightSample drawn, uint seed);

#ifdef HAS_traced_emitters
// What one shadow ray brings, per π; of the lobe's rays there are `own_rays` for each. `l`: from where.
vec3 emitter_light(TracedSurface s, float own_rays, inout PixelSampler chances, out vec3 l) {
    float choice = next(chances);
    LightSample drawn = draw_emitter(s, choice, next_pair(chances));
    l = drawn.direction;
    float nl = dot(s.shading, l);
    bool reaches = drawn.density > 0.0 && nl > 0.0 && dot(s.face, l) > 0.0 && largest(drawn.radiance) > 0.0;
    if (!reaches || emitter_is_hidden(s, drawn, sampler_key(chances, 3u))) return vec3(0.0);
    return drawn.radiance * (nl * mis_weight(drawn.density, own_rays * nl / k_pi) / (k_pi * drawn.density));
}
#endif

#endif
