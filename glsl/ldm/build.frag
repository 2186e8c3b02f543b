// One fragment of a layered depth map: front and back faces alike, where its alpha says so, into its texel's sorted list.
#define SCENE_MATERIALS
#include "lib/material_raster.glsl"
#include "ldm/insert.glsl"
#include "ldm/node.glsl"

in Surface {
    float depth;
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;
flat in uint surface_draw;
flat in int surface_slot;

uniform int batch; // its number

void main() {
    Material material = materials[surface_material];
    vec4 base = sample_base_colour(material, surface_uv(surface.uv), surface.colour);
    vec2 slope = vec2(dFdx(surface.depth), dFdy(surface.depth));
    float metallic = material.metallic *
                     sample_slot(material_metallic_roughness, material.metallic_roughness_texture, surface_uv(surface.uv)).b;
    if (gl_HelperInvocation) return; // they would loop over lists that they never change (llvmpipe does so for seconds)
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint map = uint(batch + surface_slot * ldm.batches);
    if (!surface_is_there(material, base.a, texel_place(texel, map, surface_draw, uint(gl_PrimitiveID)))) return;
    insert_fragment(uint(ldm_head(surface_slot, texel)), pack_node(surface.depth, slope, base.rgb * (1.0 - metallic)));
}
