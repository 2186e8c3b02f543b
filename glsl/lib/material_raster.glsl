#ifndef LIB_MATERIAL_RASTER_GLSL
#define LIB_MATERIAL_RASTER_GLSL
// Material textures as raster passes see them: bound per material by the draw.
#include "lib/scene.glsl"
#include "lib/coverage.glsl"

uniform sampler2D material_base_colour;       // sRGB decoded; a = alpha
uniform sampler2D material_metallic_roughness; // g = roughness, b = metallic
uniform sampler2D material_normal;
uniform sampler2D material_emission;

// Both sets of texture coordinates, and by how much they change from pixel to pixel.
struct SurfaceUv {
    vec4 at, dx, dy;
};

// Call it outside of any branch. The derivatives are those of the interpolated coordinates and not of transformed ones:
// helper invocations along the edges of triangles may read zeros from the buffer of materials (Mesa's llvmpipe does), and
// a derivative through them would fetch the coarsest mip there.
SurfaceUv surface_uv(vec4 uv) {
    return SurfaceUv(uv, dFdx(uv), dFdy(uv));
}

vec4 sample_slot(sampler2D map, TextureUse use, SurfaceUv uv) {
    return textureGrad(map, transform_uv(use, uv.at.xy, uv.at.zw), turn_uv(use, uv.dx.xy, uv.dx.zw),
                       turn_uv(use, uv.dy.xy, uv.dy.zw));
}

vec4 sample_base_colour(Material material, SurfaceUv uv, vec4 colour) {
    return material.base_colour * colour * sample_slot(material_base_colour, material.base_colour_texture, uv);
}
#endif
