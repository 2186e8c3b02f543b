// Depth of what the light sees; materials with alpha let some of it through.
#define SCENE_MATERIALS
#include "lib/material_raster.glsl"

in Surface {
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;
flat in uint surface_draw;

uniform int view_index; // which of shadow_views

void main() {
    SurfaceUv uv = surface_uv(surface.uv);
    Material material = materials[surface_material];
    float alpha = sample_base_colour(material, uv, surface.colour).a;
    if (!surface_is_there(material, alpha, texel_place(ivec2(gl_FragCoord.xy), uint(view_index), surface_draw, uint(gl_PrimitiveID)))) discard;
}
