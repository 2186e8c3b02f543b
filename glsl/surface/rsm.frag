// Reflective shadow map (Dachsbacher & Stamminger 2005; LRSM, Table 1): for each texel the light that a diffuse surface
// sends on, ρ·L_d·⟨n·l⟩/π with L_d the irradiance at normal incidence, its normal, and ⟨n·l⟩. Depth is the depth buffer. ρ is
// the diffuse lobe's albedo for light from l: the lobe's reciprocity makes it what all viewers together see. Light comes from
// a punctual light, or as parallel light from the environment.
#define SCENE_MATERIALS
#define SCENE_LIGHTS
#include "lib/frame.glsl"
#include "lib/material_raster.glsl"
#include "lib/normal_map.glsl"
#include "lib/material_model.glsl"
#include "surface/rsm_views.glsl"

layout(std430) readonly buffer rsm_parallel { vec4 parallel_irradiance[]; }; //! optional

uniform int light_index; // below 0: the environment
uniform int view_index; // which of rsm_views

in Surface {
    vec3 position;
    vec3 normal;
    vec4 tangent;
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;
flat in uint surface_draw;

layout(location = 0) out vec4 radiance; // a = ⟨n·l⟩
layout(location = 1) out vec4 normal;   // world, toward the light; a = 1 where there is a surface

void main() {
    Material material = materials[surface_material];
    SurfaceUv uv = surface_uv(surface.uv);
    vec4 base = sample_base_colour(material, uv, surface.colour);
    vec3 mapped = sample_slot(material_normal, material.normal_texture, uv).xyz;
    vec2 rm = vec2(material.roughness, material.metallic) * sample_slot(material_metallic_roughness, material.metallic_roughness_texture, uv).gb;
    vec3 face = cross(dFdx(surface.position), dFdy(surface.position));
    if (!surface_is_there(material, base.a, texel_place(ivec2(gl_FragCoord.xy), uint(view_index), surface_draw, uint(gl_PrimitiveID)))) discard;

    vec3 l = -views[view_index].direction, irradiance;
    if (light_index < 0) irradiance = parallel_irradiance[view_index].rgb;
    else irradiance = light_irradiance(lights[light_index], surface.position, l);
    face = unit_or(face, unit_or(surface.normal, l));
    vec3 authored = unit_or(surface.normal, face);
    vec3 n = turn_toward_viewer(shading_normal(material, authored, surface.tangent, mapped), face, l);
    float cosine = max(dot(n, l), 0.0);
    rm = clamp(rm, 0.0, 1.0);
    vec3 rho = diffuse_albedo(base.rgb, rm.y, rm.x, cosine);
    radiance = vec4(min(rho / k_pi * irradiance * cosine, vec3(65504.0)), cosine);
    normal = vec4(n, 1.0);
}
