#ifndef LIB_LOBES_GLSL
#define LIB_LOBES_GLSL
// A surface's two lobes as seen from one direction, to be evaluated and drawn from (passes/reference/integrator.cpp).
#include "lib/material_model.glsl"
#include "lib/sampling.glsl"
#include "voxel/cone_set.glsl"

struct Lobes {
    vec3 n, v;
    vec3 f0;
    float nv, alpha;
    bool glossy;
    mat3 frame;        // x, y, n
    float gloss_share; // of what is drawn from both
};

Lobes lobes_at(vec3 n, vec3 v, vec3 base_colour, float metallic, float roughness) {
    Lobes lobes;
    lobes.n = n;
    lobes.v = v;
    lobes.f0 = brdf_f0(base_colour, metallic);
    lobes.nv = dot(n, v);
    lobes.alpha = brdf_alpha(roughness);
    lobes.glossy = diffuse_only == 0 && lobes.nv > 0.0;
    lobes.frame = frame_around(n);
    lobes.gloss_share = 0.0;
    if (lobes.glossy) {
        // Schlick at the viewing angle is near enough for a choice between lobes.
        float m = 1.0 - min(lobes.nv, 1.0), m2 = m * m;
        float specular = luminance(lobes.f0 + (1.0 - lobes.f0) * (m2 * m2 * m)), diffuse = luminance(brdf_diffuse(base_colour, metallic)) * k_pi;
        lobes.gloss_share = diffuse > 0.0 ? clamp(specular / (specular + diffuse), 0.1, 0.9) : 1.0;
    }
    return lobes;
}

// The microfacet lobe, and in a the density with which draw_gloss draws l.
vec4 gloss_toward(Lobes lobes, vec3 l) {
    float nl = dot(lobes.n, l);
    if (!lobes.glossy || nl <= 0.0) return vec4(0.0);
    vec3 h = normalize(lobes.v + l);
    float d = ggx_density(lobes.n, h, lobes.alpha);
    vec3 fresnel = lobes.f0 + (1.0 - lobes.f0) * schlick_weight(lobes.v, h);
    return vec4(fresnel * (d * smith_visibility(nl, lobes.nv, lobes.alpha)), visible_normal_density(d, lobes.nv, lobes.alpha));
}

vec3 draw_diffuse(Lobes lobes, vec2 u) {
    return lobes.frame * cosine_hemisphere(u);
}

vec3 draw_gloss(Lobes lobes, vec2 u) {
    vec3 h = lobes.frame * visible_normal(lobes.v * lobes.frame, lobes.alpha, u);
    return normalize(2.0 * dot(lobes.v, h) * h - lobes.v);
}

#endif
