#ifndef TRACED_LOBES_GLSL
#define TRACED_LOBES_GLSL
// The lobes of a surface that a ray met.
#include "lib/lobes.glsl"
#include "traced/surface.glsl"

uniform bool microfacets = true; //! off: every surface has its diffuse lobe alone

Lobes without_gloss(Lobes lobes) {
    lobes.glossy = false;
    lobes.gloss_share = 0.0;
    return lobes;
}

Lobes lobes_of(TracedSurface s, vec3 v) {
    Lobes lobes = lobes_at(s.shading, v, s.base_colour, s.metallic, s.roughness);
    return microfacets ? lobes : without_gloss(lobes);
}

// Light from below the surface itself is blocked by it, whatever the shading normal says.
bool above(TracedSurface s, vec3 l) {
    return dot(s.face, l) > 0.0;
}

// Both lobes, and in a the density of l when one of them is drawn by its share.
vec4 both_toward(TracedSurface s, Lobes lobes, vec3 l) {
    vec4 gloss = gloss_toward(lobes, l);
    float nl = dot(lobes.n, l);
    return vec4(diffuse_lobe(lobes.n, lobes.v, l, s.base_colour, s.metallic, s.roughness) + gloss.rgb,
                lobes.gloss_share * gloss.a + (1.0 - lobes.gloss_share) * nl / k_pi);
}

#endif
