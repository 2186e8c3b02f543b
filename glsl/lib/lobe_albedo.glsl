#ifndef LIB_LOBE_ALBEDO_GLSL
#define LIB_LOBE_ALBEDO_GLSL
// Directional albedos of the two lobes: what each reflects of light that is the same from all around, seen (or lit) under
// one cosine. The microfacet lobe's comes from a table, linear in F0; the diffuse lobe's of glTF's model from a closed form.
// passes/scene/lobe_albedo.h mirrors this file, and says more.
#include "lib/brdf.glsl"

uniform sampler2D scene_lobe_albedo; // 32²: row = roughness, column = √cosine; r, g = a, b of F0·a + b

// Linear between the entries, by hand: the filters of some GPUs have 8 bits.
vec2 lobe_albedo_at(float cosine, float roughness) {
    vec2 at = clamp(vec2(sqrt(clamp(cosine, 0.0, 1.0)), roughness), 0.0, 1.0) * 31.0;
    ivec2 cell = min(ivec2(at), ivec2(30));
    vec2 share = at - vec2(cell);
    vec2 low = mix(texelFetch(scene_lobe_albedo, cell, 0).rg, texelFetch(scene_lobe_albedo, cell + ivec2(1, 0), 0).rg, share.x);
    vec2 high = mix(texelFetch(scene_lobe_albedo, cell + ivec2(0, 1), 0).rg, texelFetch(scene_lobe_albedo, cell + ivec2(1, 1), 0).rg, share.x);
    return mix(low, high, share.y);
}

// ∫ D·V·F·⟨n·l⟩ dl
vec3 microfacet_albedo(vec3 f0, float roughness, float cosine) {
    vec2 ab = lobe_albedo_at(cosine, roughness);
    return f0 * ab.x + ab.y;
}

// ∫ (1 − F(v·h))·⟨n·l⟩/π dl, within 6e-6.
float fresnel_diffuse_albedo(float cosine) {
    float c = clamp(cosine, 0.0, 1.0);
    float w = 0.02816111 + c * (-0.07980661 + c * (0.08627045 + c * (-0.04340026 + c * 0.00885729)));
    return (1.0 - k_dielectric_f0) * (1.0 - w);
}
const float k_mean_fresnel_diffuse_albedo = 0.956465;

// The share that is left of the diffuse lobe of albedo `rho`, so that both lobes together do not send out more than comes in.
vec3 diffuse_limit(vec3 rho, vec3 f0, float roughness, float cosine) {
    vec3 left = max(1.0 - microfacet_albedo(f0, roughness, cosine), 0.0);
    return min(left / max(rho * fresnel_diffuse_albedo(cosine), 1.0e-6), 1.0);
}
#endif
