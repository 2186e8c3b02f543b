#ifndef LIB_SCENE_TEXTURES_GLSL
#define LIB_SCENE_TEXTURES_GLSL
// Material textures as compute passes see them: arrays bucketed by size. Include lib/scene.glsl with SCENE_GEOMETRY
// before this file.
uniform sampler2DArray scene_textures[8];

// Samplers may only be indexed by what is the same for all invocations: each array is asked in turn. `footprint`: the area
// that is averaged, in texture coordinates squared; the mip whose texels are as large, but no coarser than `coarsest`.
vec4 sample_scene_texture(TextureUse use, vec2 uv0, vec2 uv1, float footprint, float coarsest) {
    vec3 at = vec3(transform_uv(use, uv0, uv1), float(use.layer));
    vec4 value = vec4(1.0);
    for (int i = 0; i < 8; ++i) {
        if (i != use.array) continue;
        vec2 size = vec2(textureSize(scene_textures[i], 0).xy);
        value = textureLod(scene_textures[i], at, clamp(0.5 * log2(max(footprint * size.x * size.y, 1.0)), 0.0, coarsest));
    }
    return value;
}

vec2 corner_uv0(Vertex corner) {
    return vec2(corner.position_u.w, corner.normal_v.w);
}

// The alpha of a triangle's surface at the point of its plane next to `at`, clamped into the triangle. `positions` are the
// corners in the units of `at`; the texture is averaged over one such unit squared, up to 16 × 16 texels (beyond, thin leaves
// would blur away).
float alpha_at(Material material, Vertex corners[3], vec3 positions[3], vec3 at) {
    vec3 e1 = positions[1] - positions[0], e2 = positions[2] - positions[0], d = at - positions[0];
    float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), d1 = dot(d, e1), d2 = dot(d, e2);
    float area = max(d11 * d22 - d12 * d12, 1.0e-20);
    vec2 share = clamp(vec2(d22 * d1 - d12 * d2, d11 * d2 - d12 * d1) / area, vec2(0.0), vec2(1.0));
    share /= max(share.x + share.y, 1.0);
    vec3 weight = vec3(1.0 - share.x - share.y, share);
    vec2 uv0 = vec2(0.0), uv1 = vec2(0.0);
    vec4 colour = vec4(0.0);
    for (int i = 0; i < 3; ++i) {
        uv0 += weight[i] * corner_uv0(corners[i]);
        uv1 += weight[i] * corners[i].uv1;
        colour += weight[i] * vec4(unpackUnorm2x16(corners[i].colour.x), unpackUnorm2x16(corners[i].colour.y));
    }
    float alpha = material.base_colour.a * colour.a;
    if (material.base_colour_texture.array < 0) return alpha;
    vec2 u1 = turn_uv(material.base_colour_texture, corner_uv0(corners[1]) - corner_uv0(corners[0]), corners[1].uv1 - corners[0].uv1);
    vec2 u2 = turn_uv(material.base_colour_texture, corner_uv0(corners[2]) - corner_uv0(corners[0]), corners[2].uv1 - corners[0].uv1);
    float footprint = abs(u1.x * u2.y - u1.y * u2.x) / sqrt(area);
    return alpha * sample_scene_texture(material.base_colour_texture, uv0, uv1, footprint, 4.0).a;
}

#endif
