#ifndef LIB_MATERIAL_RASTER_GLSL
#define LIB_MATERIAL_RASTER_GLSL
// Material textures as raster passes see them: bound per material by the draw.
#include "lib/scene.glsl"

uniform sampler2D material_base_colour;       // sRGB decoded; a = alpha
uniform sampler2D material_metallic_roughness; // g = roughness, b = metallic
uniform sampler2D material_normal;
uniform sampler2D material_emission;

vec4 sample_base_colour(Material material, vec2 uv0, vec2 uv1, vec4 colour) {
    return material.base_colour * colour * texture(material_base_colour, transform_uv(material.base_colour_texture, uv0, uv1));
}

bool alpha_rejects(Material material, float alpha) {
    return material.alpha_cutoff >= 0.0 && alpha < material.alpha_cutoff;
}
#endif
