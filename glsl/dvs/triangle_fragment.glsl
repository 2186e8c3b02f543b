#ifndef DVS_TRIANGLE_FRAGMENT_GLSL
#define DVS_TRIANGLE_FRAGMENT_GLSL
// What a triangle's surface is inside a voxel, found without a rasterizer. Include voxel/scene_triangles.glsl first.
#include "dvs/voxel_fragment.glsl"

VoxelFragment fragment_of(VisitedTriangle t, ivec3 voxel) {
    Vertex corners[3] = corners_of(t);
    TrianglePoint point = triangle_point(corners, t.positions, vec3(voxel) + 0.5);
    Material m = materials[t.material];
    vec3 facing = facing_of(t, corners);
    VoxelFragment f;
    float metallic = clamp(m.metallic * sample_at_point(m.metallic_roughness_texture, point, 16.0).b, 0.0, 1.0);
    f.albedo = (m.base_colour * point.colour * sample_at_point(m.base_colour_texture, point, 16.0)).rgb * (1.0 - metallic);
    f.emission = k_emission ? m.emission * sample_at_point(m.emission_texture, point, 16.0).rgb : vec3(0.0);
    vec3 authored = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        authored += point.weight[i] * corners[i].normal_v.xyz;
    authored = mat3(draws[t.draw].normal_matrix) * authored;
    float size = length(authored);
    f.normal = size > 0.0 ? authored / size : facing;
    f.leaves = leaves_of(facing, (m.flags & 1u) != 0u);
    place_fragment(f, t.positions[0], t.positions[1], t.positions[2], facing, voxel);
    return f;
}

#endif
