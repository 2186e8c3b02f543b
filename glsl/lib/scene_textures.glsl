#ifndef LIB_SCENE_TEXTURES_GLSL
#define LIB_SCENE_TEXTURES_GLSL
// Material textures as compute passes see them: arrays bucketed by size. Include lib/scene.glsl with SCENE_GEOMETRY
// before this file.
uniform sampler2DArray scene_textures[8];

// Samplers may only be indexed by what is the same for all invocations: each array is asked in turn.
vec4 sample_scene_texture(TextureUse use, vec2 uv0, vec2 uv1, float level) {
    vec3 at = vec3(transform_uv(use, uv0, uv1), float(use.layer));
    vec4 value = vec4(1.0);
    for (int i = 0; i < 8; ++i)
        if (i == use.array) value = textureLod(scene_textures[i], at, level);
    return value;
}

// What a triangle's surface carries at a point.
struct TrianglePoint {
    vec3 weight; // of the three corners
    vec2 uv0, uv1;
    vec4 colour;
    float level; // mip, of about one unit of the positions
};

// At the point of the triangle's plane next to `at`, clamped into the triangle. `positions` are the corners in the units of
// `at`.
TrianglePoint triangle_point(Vertex corners[3], vec3 positions[3], vec3 at) {
    vec3 e1 = positions[1] - positions[0], e2 = positions[2] - positions[0], d = at - positions[0];
    float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), d1 = dot(d, e1), d2 = dot(d, e2);
    float area = max(d11 * d22 - d12 * d12, 1.0e-20);
    vec2 share = clamp(vec2(d22 * d1 - d12 * d2, d11 * d2 - d12 * d1) / area, vec2(0.0), vec2(1.0));
    share /= max(share.x + share.y, 1.0);
    TrianglePoint point;
    point.weight = vec3(1.0 - share.x - share.y, share);
    point.uv0 = point.uv1 = vec2(0.0);
    point.colour = vec4(0.0);
    for (int i = 0; i < 3; ++i) {
        point.uv0 += point.weight[i] * vec2(corners[i].position_u.w, corners[i].normal_v.w);
        point.uv1 += point.weight[i] * corners[i].uv1;
        point.colour += point.weight[i] * vec4(unpackUnorm2x16(corners[i].colour.x), unpackUnorm2x16(corners[i].colour.y));
    }
    vec2 u = vec2(corners[1].position_u.w - corners[0].position_u.w, corners[1].normal_v.w - corners[0].normal_v.w);
    vec2 texels = vec2(512.0) * abs(u) / sqrt(max(d11, 1.0e-20));
    point.level = clamp(log2(max(max(texels.x, texels.y), 1.0)), 0.0, 4.0);
    return point;
}

vec4 sample_at_point(TextureUse use, TrianglePoint point) {
    return use.array < 0 ? vec4(1.0) : sample_scene_texture(use, point.uv0, point.uv1, point.level);
}

// The alpha of a triangle's surface at the point next to `at`.
float alpha_at(Material material, Vertex corners[3], vec3 positions[3], vec3 at) {
    TrianglePoint point = triangle_point(corners, positions, at);
    return material.base_colour.a * point.colour.a * sample_at_point(material.base_colour_texture, point).a;
}

#endif
