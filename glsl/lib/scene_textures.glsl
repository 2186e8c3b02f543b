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
    // The level first: a size and a lookup in one branch crash the compiler of llvmpipe (LLVM 15) for some arrays.
    float level = 0.0;
    for (int i = 0; i < 8; ++i) {
        if (i != use.array) continue;
        ivec2 size = textureSize(scene_textures[i], 0).xy;
        level = coarsest > 0.0 ? clamp(0.5 * log2(max(footprint * float(size.x * size.y), 1.0)), 0.0, coarsest) : 0.0;
    }
    for (int i = 0; i < 8; ++i) {
        if (i == use.array) value = textureLod(scene_textures[i], at, level);
    }
    return value;
}

vec2 corner_uv0(Vertex corner) {
    return vec2(corner.position_u.w, corner.normal_v.w);
}

// What a triangle's surface carries at a point.
struct TrianglePoint {
    vec3 weight; // of the three corners
    vec2 uv0, uv1;
    vec4 colour;
    mat2 edges_uv0, edges_uv1; // the two edges from corner 0
    float parallelogram;       // of the two edges, squared units of the positions
};

// At the point that is the corners' weighted mean. `parallelogram`: area of the two edges', in squared units of a footprint.
TrianglePoint triangle_point_of(Vertex corners[3], vec3 weight, float parallelogram) {
    TrianglePoint point;
    point.weight = weight;
    point.uv0 = point.uv1 = vec2(0.0);
    point.colour = vec4(0.0);
    for (int i = 0; i < 3; ++i) {
        point.uv0 += point.weight[i] * corner_uv0(corners[i]);
        point.uv1 += point.weight[i] * corners[i].uv1;
        point.colour += point.weight[i] * vec4(unpackUnorm2x16(corners[i].colour.x), unpackUnorm2x16(corners[i].colour.y));
    }
    point.edges_uv0 = mat2(corner_uv0(corners[1]) - corner_uv0(corners[0]), corner_uv0(corners[2]) - corner_uv0(corners[0]));
    point.edges_uv1 = mat2(corners[1].uv1 - corners[0].uv1, corners[2].uv1 - corners[0].uv1);
    point.parallelogram = parallelogram;
    return point;
}

// At the point of the triangle's plane next to `at`, clamped into the triangle. `positions` are the corners in the units of
// `at`.
TrianglePoint triangle_point(Vertex corners[3], vec3 positions[3], vec3 at) {
    vec3 e1 = positions[1] - positions[0], e2 = positions[2] - positions[0], d = at - positions[0];
    float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), d1 = dot(d, e1), d2 = dot(d, e2);
    float area = max(d11 * d22 - d12 * d12, 1.0e-20);
    vec2 share = clamp(vec2(d22 * d1 - d12 * d2, d11 * d2 - d12 * d1) / area, vec2(0.0), vec2(1.0));
    share /= max(share.x + share.y, 1.0);
    return triangle_point_of(corners, vec3(1.0 - share.x - share.y, share), sqrt(area));
}

// A texture there, averaged over one squared unit of the positions up to mip `coarsest`; white where there is none.
vec4 sample_at_point(TextureUse use, TrianglePoint point, float coarsest) {
    if (use.array < 0) return vec4(1.0);
    vec2 u1 = turn_uv(use, point.edges_uv0[0], point.edges_uv1[0]), u2 = turn_uv(use, point.edges_uv0[1], point.edges_uv1[1]);
    float footprint = abs(u1.x * u2.y - u1.y * u2.x) / point.parallelogram;
    return sample_scene_texture(use, point.uv0, point.uv1, footprint, coarsest);
}

// The alpha of a triangle's surface; the texture is averaged over up to 16 × 16 texels (beyond, thin leaves would blur
// away).
float alpha_of(Material material, TrianglePoint point) {
    return material.base_colour.a * point.colour.a * sample_at_point(material.base_colour_texture, point, 4.0).a;
}

// The same at the point next to `at`.
float alpha_at(Material material, Vertex corners[3], vec3 positions[3], vec3 at) {
    return alpha_of(material, triangle_point(corners, positions, at));
}

#endif
