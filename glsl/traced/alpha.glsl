#ifndef TRACED_ALPHA_GLSL
#define TRACED_ALPHA_GLSL
// Whether a triangle is there where a ray met it.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#define SCENE_LIGHTS // for those who include this: lib/scene.glsl is read once
#include "lib/scene.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"

vec4 corner_colour(Vertex corner) {
    return vec4(unpackUnorm2x16(corner.colour.x), unpackUnorm2x16(corner.colour.y));
}

bool triangle_is_there(uint draw_index, uint corner, vec2 uv, uint seed) {
    Draw draw = draws[draw_index];
    Material material = materials[draw.material];
    vec3 weight = vec3(1.0 - uv.x - uv.y, uv);
    vec2 uv0 = vec2(0.0), uv1 = vec2(0.0);
    float alpha = 0.0;
    for (int k = 0; k < 3; ++k) {
        Vertex vertex = vertices[indices[corner + uint(k)]];
        uv0 += weight[k] * corner_uv0(vertex);
        uv1 += weight[k] * vertex.uv1;
        alpha += weight[k] * corner_colour(vertex).a;
    }
    alpha *= material.base_colour.a;
    if (material.base_colour_texture.array >= 0) alpha *= sample_scene_texture(material.base_colour_texture, uv0, uv1, 0.0, 0.0).a;
    if (seed == 0u && material.alpha_cutoff < 0.0) return !alpha_matters(material) || alpha >= 0.5;
    uint triangle = (corner - draw.first_index) / 3u;
    return surface_is_there(material, alpha, hash_combine(hash_combine(seed, draw_index), triangle));
}

#endif
