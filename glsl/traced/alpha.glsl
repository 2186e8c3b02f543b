#ifndef TRACED_ALPHA_GLSL
#define TRACED_ALPHA_GLSL
// Whether a triangle is there where a ray met it.
#include "traced/hit.glsl"
#ifdef HAS_traced_alpha
#define SCENE_DRAWS
#define SCENE_MATERIALS
#include "lib/scene.glsl" // who needs more of the scene has included traced/scene.glsl before
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"
#endif

uniform usampler2D traced_alpha; //! optional

// `record`: its number, from 1 on; three texels each (passes/traced/scene_trees.h).
bool triangle_is_there(uint record, uint draw_index, uint corner, vec2 uv, uint seed) {
#ifdef HAS_traced_alpha
    uint at_texel = 3u * (record - 1u);
    uvec4 texels[3];
    for (uint k = 0u; k < 3u; ++k) texels[k] = texelFetch(traced_alpha, ivec2((at_texel + k) & 8191u, (at_texel + k) >> 13), 0);
    vec4 first = uintBitsToFloat(texels[0]), second = uintBitsToFloat(texels[1]);
    uvec4 last = texels[2];
    vec3 weight = vec3(1.0 - uv.x - uv.y, uv);
    float cutoff = uintBitsToFloat(last.y), alpha = dot(weight, vec3(second.zw, uintBitsToFloat(last.x)));
    TextureUse use = TextureUse(materials[last.z].base_colour_texture.array, materials[last.z].base_colour_texture.layer, 0u, 0.0, vec2(0.0), vec2(1.0));
    vec2 at = weight.x * first.xy + weight.y * first.zw + weight.z * second.xy;
    if (use.array >= 0) alpha *= sample_scene_texture(use, at, at, 0.0, 0.0).a;
    if (cutoff >= 0.0) return alpha >= mask_threshold(cutoff);
    if (seed == 0u) return alpha >= 0.5;
    uint triangle = (corner - draws[draw_index].first_index) / 3u;
    return alpha >= coverage_threshold(hash_combine(hash_combine(seed, draw_index), triangle));
#else
    return true;
#endif
}

#endif
