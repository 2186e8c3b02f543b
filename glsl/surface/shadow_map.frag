// Depth of what the light sees; alpha-tested materials let it through.
#define SCENE_MATERIALS
#include "lib/material_raster.glsl"

in Surface {
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;

void main() {
    SurfaceUv uv = surface_uv(surface.uv);
    Material material = materials[surface_material];
    if (material.alpha_cutoff < 0.0) return;
    if (alpha_rejects(material, sample_base_colour(material, uv, surface.colour).a)) discard;
}
