// Writes what is seen: base colour, normals turned toward the viewer, roughness and metallic, emission.
#define SCENE_MATERIALS
#include "lib/frame.glsl"
#include "lib/material_raster.glsl"
#include "lib/normal_map.glsl"
#include "lib/brdf.glsl"

in Surface {
    vec3 position;
    vec3 normal;
    vec4 tangent;
    vec4 uv;
    vec4 colour;
    vec3 motion;
} surface;
flat in uint surface_material;
flat in uint surface_draw;

uniform bool coverage_by_frame = false; //! static where blended surfaces are is drawn anew in each frame

layout(location = 0) out vec4 albedo;           // base colour; a = 1 where there is a surface
layout(location = 1) out vec4 normal;           // shading normal, world
layout(location = 2) out vec4 geometric_normal; // of the triangle, world
layout(location = 3) out vec2 roughness_metallic;
layout(location = 4) out vec4 emission; // radiance, W/(sr·m²)
layout(location = 5) out vec4 motion;   // to where the surface was a frame ago, metres

void main() {
    Material material = materials[surface_material];
    SurfaceUv uv = surface_uv(surface.uv);
    vec4 base = sample_base_colour(material, uv, surface.colour);
    vec3 mapped = sample_slot(material_normal, material.normal_texture, uv).xyz;
    vec2 rm = sample_slot(material_metallic_roughness, material.metallic_roughness_texture, uv).gb;
    vec3 glow = sample_slot(material_emission, material.emission_texture, uv).rgb;
    vec3 face = cross(dFdx(surface.position), dFdy(surface.position));
    uint view = coverage_by_frame ? uint(frame_index) + 1u : 0u;
    if (!surface_is_there(material, base.a, texel_place(ivec2(gl_FragCoord.xy), view, surface_draw, uint(gl_PrimitiveID)))) discard;

    vec3 to_viewer = normalize(camera_position - surface.position);
    face = unit_or(face, unit_or(surface.normal, to_viewer));
    if (dot(face, to_viewer) < 0.0) face = -face;
    vec3 authored = unit_or(surface.normal, face);

    vec3 shading = shading_normal(material, authored, surface.tangent, mapped);
    shading = turn_toward_viewer(shading, face, to_viewer);

    albedo = vec4(base.rgb, 1.0);
    normal = vec4(shading, 0.0);
    geometric_normal = vec4(face, 0.0);
    roughness_metallic = clamp(vec2(material.roughness * rm.x, material.metallic * rm.y), 0.0, 1.0);
    motion = vec4(surface.motion, 0.0);
    emission = vec4(min(material.emission * glow, vec3(65504.0)), 0.0);
}
