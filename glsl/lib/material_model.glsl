#ifndef LIB_MATERIAL_MODEL_GLSL
#define LIB_MATERIAL_MODEL_GLSL
// The shot's surface model (`material_model`; passes/scene/material_model.h). Whoever knows the directions of view and of
// light evaluates the lobes; a gather over the hemisphere, or a structure that is seen from anywhere, knows one of them or
// none, and takes the diffuse lobe's directional albedo for that one, or its mean. The plain sum and Lambert: rho.
#include "lib/frame.glsl"
#include "lib/lobe_albedo.glsl"

const int k_model_plain = 0;
const int k_model_gltf = 1;

bool lambert_lobe() {
    return material_model == k_model_plain || diffuse_only != 0;
}

// The diffuse lobe without the cosine.
vec3 diffuse_lobe(vec3 n, vec3 v, vec3 l, vec3 base_colour, float metallic, float roughness) {
    vec3 lambert = brdf_diffuse(base_colour, metallic);
    if (lambert_lobe()) return lambert;
    lambert *= fresnel_diffuse_weight(v, normalize(v + l));
    float nv = dot(n, v), nl = dot(n, l);
    if (material_model != k_model_gltf || nv <= 0.0 || nl <= 0.0) return lambert;
    vec3 rho = base_colour * (1.0 - metallic), f0 = brdf_f0(base_colour, metallic);
    return lambert * min(diffuse_limit(rho, f0, roughness, nv), diffuse_limit(rho, f0, roughness, nl));
}

// Both lobes without the cosine.
vec3 surface_lobes(vec3 n, vec3 v, vec3 l, vec3 base_colour, float metallic, float roughness) {
    vec3 f = diffuse_lobe(n, v, l, base_colour, metallic, roughness);
    if (diffuse_only == 0) f += brdf_specular(n, v, l, base_colour, metallic, roughness);
    return f;
}

// The diffuse lobe's albedo with one direction known, at `cosine` to the normal: what a viewer there sees of even light, or
// what is sent on, all directions together, of light from there. (The limit of the other direction is left out: 4 % too
// much for a smooth white dielectric, under .5 % for albedos up to .8 with roughness from .3 on.)
vec3 diffuse_albedo(vec3 base_colour, float metallic, float roughness, float cosine) {
    vec3 rho = base_colour * (1.0 - metallic);
    if (lambert_lobe()) return rho;
    vec3 seen = rho * fresnel_diffuse_albedo(cosine);
    if (material_model != k_model_gltf || cosine <= 0.0) return seen;
    return seen * diffuse_limit(rho, brdf_f0(base_colour, metallic), roughness, cosine);
}

// What the model leaves of an albedo whose roughness is not known: with one direction known, or none.
float diffuse_share(float cosine) {
    return lambert_lobe() ? 1.0 : fresnel_diffuse_albedo(cosine);
}
float mean_diffuse_share() {
    return lambert_lobe() ? 1.0 : k_mean_fresnel_diffuse_albedo;
}
#endif
