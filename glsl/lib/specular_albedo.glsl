#ifndef LIB_SPECULAR_ALBEDO_GLSL
#define LIB_SPECULAR_ALBEDO_GLSL
// What the microfacet lobe reflects of light that is the same from all around its lobe: ∫ f_s(v, l)·⟨n·l⟩ dl, linear in F0.
// With the plain sum by Karis' fit ("Physically based shading on mobile", 2014); with glTF's model by the table that its
// limit of the diffuse lobe goes by too.
#include "lib/material_model.glsl"

vec3 specular_albedo(vec3 base_colour, float metallic, float roughness, float nv) {
    if (material_model != k_model_plain) return microfacet_albedo(brdf_f0(base_colour, metallic), roughness, nv);
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 scale_offset = vec2(-1.04, 1.04) * a + r.zw;
    return max(brdf_f0(base_colour, metallic) * scale_offset.x + scale_offset.y, vec3(0.0));
}
#endif
