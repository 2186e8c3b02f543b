#ifndef LIB_SCENE_GLSL
#define LIB_SCENE_GLSL
// The scene's buffers, for any shader that asks for them. passes/gpu_scene/gpu_scene.h mirrors the structs (std430).
// Define the ones that you want before including: SCENE_DRAWS, SCENE_MATERIALS, SCENE_LIGHTS, SCENE_GEOMETRY.
#include "lib/light.glsl"

struct Vertex {
    vec4 position_u; // position, TEXCOORD_0.x
    vec4 normal_v;   // normal, TEXCOORD_0.y
    vec4 tangent;    // w = handedness
    vec2 uv1;        // TEXCOORD_1
    uvec2 colour;    // COLOR_0 as unorm16
};

struct Draw {
    mat4 world;
    mat4 previous_world; // one frame earlier
    mat4 normal_matrix;  // transposed inverse of world's 3×3
    uint material;
    uint first_index;
    uint index_count;
    uint flags; // 1 = dynamic, 2 = mirrored: world's determinant is negative
};

struct TextureUse {
    int array; // which of scene_textures; −1 = none
    int layer;
    uint uv_set;
    float rotation;
    vec2 offset;
    vec2 scale;
};

struct Material {
    vec4 base_colour;
    vec3 emission;      // radiance
    float alpha_cutoff; // −1: opaque; −2: blended (lib/coverage.glsl)
    float metallic;
    float roughness;
    float normal_scale;
    uint flags; // 1 = double-sided
    TextureUse base_colour_texture;
    TextureUse metallic_roughness_texture;
    TextureUse normal_texture;
    TextureUse emission_texture;
};

#ifdef SCENE_DRAWS
layout(std430) readonly buffer scene_draws { Draw draws[]; };

// Unit, however small or large; 0 stays 0.
vec3 unit_or_zero(vec3 v) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

// A vertex's unit normal and tangent in the world. A mirroring transform turns the frame's handedness over.
vec3 world_normal(Draw draw, vec3 normal) {
    return unit_or_zero(mat3(draw.normal_matrix) * normal);
}
vec4 world_tangent(Draw draw, vec4 tangent) {
    return vec4(unit_or_zero(mat3(draw.world) * tangent.xyz), (draw.flags & 2u) != 0u ? -tangent.w : tangent.w);
}
#endif
#ifdef SCENE_MATERIALS
layout(std430) readonly buffer scene_materials { Material materials[]; };
#endif
#ifdef SCENE_LIGHTS
layout(std430) readonly buffer scene_lights { Light lights[]; };
#endif
#ifdef SCENE_GEOMETRY
layout(std430) readonly buffer scene_vertices { Vertex vertices[]; };
layout(std430) readonly buffer scene_indices { uint indices[]; };
#endif

// KHR_texture_transform: offset + R(rotation)·(scale·uv). `turn_uv` is its linear part, as derivatives need it.
vec2 turn_uv(TextureUse use, vec2 uv0, vec2 uv1) {
    vec2 uv = (use.uv_set == 0u ? uv0 : uv1) * use.scale;
    float s = sin(use.rotation), c = cos(use.rotation);
    return vec2(c * uv.x + s * uv.y, -s * uv.x + c * uv.y);
}

vec2 transform_uv(TextureUse use, vec2 uv0, vec2 uv1) {
    return use.offset + turn_uv(use, uv0, uv1);
}

#endif
