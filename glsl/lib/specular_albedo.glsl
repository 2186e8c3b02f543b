#ifndef LIB_SPECULAR_ALBEDO_GLSL
#define LIB_SPECULAR_ALBEDO_GLSL
// What the microfacet lobe reflects of light that is the same from all around: ∫ f_s(v, l)·⟨n·l⟩ dl.
#include "lib/lobe_albedo.glsl"

vec3 specular_albedo(vec3 base_colour, float metallic, float roughness, float nv) {
    return microfacet_albedo(brdf_f0(base_colour, metallic), roughness, nv);
}
#endif
