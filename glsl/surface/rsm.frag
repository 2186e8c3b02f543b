// Reflective shadow map (Dachsbacher & Stamminger 2005; LRSM, Table 1): for each texel the light that a diffuse surface
// sends on, ρ·L_d·⟨n·l⟩/π with L_d the irradiance at normal incidence, its normal, and ⟨n·l⟩. Depth is the depth buffer.
#define SCENE_MATERIALS
#define SCENE_LIGHTS
#include "lib/frame.glsl"
#include "lib/material_raster.glsl"
#include "lib/normal_map.glsl"
#include "lib/brdf.glsl"

uniform int light_index;

in Surface {
    vec3 position;
    vec3 normal;
    vec4 tangent;
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;

layout(location = 0) out vec4 radiance; // a = ⟨n·l⟩
layout(location = 1) out vec4 normal;   // world, toward the light; a = 1 where there is a surface

void main() {
    Material material = materials[surface_material];
    SurfaceUv uv = surface_uv(surface.uv);
    vec4 base = sample_base_colour(material, uv, surface.colour);
    vec3 mapped = sample_slot(material_normal, material.normal_texture, uv).xyz;
    float metallic = material.metallic * sample_slot(material_metallic_roughness, material.metallic_roughness_texture, uv).b;
    vec3 face = cross(dFdx(surface.position), dFdy(surface.position));
    if (alpha_rejects(material, base.a)) discard;

    vec3 l;
    vec3 irradiance = light_irradiance(lights[light_index], surface.position, l);
    face = unit_or(face, unit_or(surface.normal, l));
    vec3 authored = unit_or(surface.normal, face);
    vec3 n = turn_toward_viewer(shading_normal(material, authored, surface.tangent, mapped), face, l);
    float cosine = max(dot(n, l), 0.0);
    radiance = vec4(min(brdf_diffuse(base.rgb, clamp(metallic, 0.0, 1.0)) * irradiance * cosine, vec3(65504.0)), cosine);
    normal = vec4(n, 1.0);
}
