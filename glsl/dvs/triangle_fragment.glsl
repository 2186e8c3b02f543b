#ifndef DVS_TRIANGLE_FRAGMENT_GLSL
#define DVS_TRIANGLE_FRAGMENT_GLSL
// What a triangle's surface is inside a voxel: ρ = base colour·(1 − metallic), the shading normal as authored, emission, and
// the leaves that it faces. Include voxel/triangle_voxels.glsl first.
struct VoxelFragment {
    vec3 albedo;
    vec3 normal; // unit
    vec3 emission;
    uint leaves; // bit 2·axis faces +axis, the next −axis
};

uniform float leaf_threshold = 0.3; //! [0, 1] directional leaves: the cosine to an axis from which a surface blocks along it

uint leaves_of(vec3 facing, bool both_sides) {
    uint leaves = 0u;
    for (int axis = 0; axis < 3; ++axis) {
        if (facing[axis] > leaf_threshold || (both_sides && -facing[axis] > leaf_threshold)) leaves |= 1u << (2 * axis);
        if (-facing[axis] > leaf_threshold || (both_sides && facing[axis] > leaf_threshold)) leaves |= 2u << (2 * axis);
    }
    return leaves;
}

VoxelFragment fragment_of(VisitedTriangle t, ivec3 voxel) {
    Vertex corners[3] = corners_of(t);
    TrianglePoint point = triangle_point(corners, t.positions, vec3(voxel) + 0.5);
    Material m = materials[t.material];
    vec3 facing = facing_of(t, corners);
    VoxelFragment f;
    float metallic = clamp(m.metallic * sample_at_point(m.metallic_roughness_texture, point, 16.0).b, 0.0, 1.0);
    f.albedo = (m.base_colour * point.colour * sample_at_point(m.base_colour_texture, point, 16.0)).rgb * (1.0 - metallic);
    f.emission = m.emission * sample_at_point(m.emission_texture, point, 16.0).rgb;
    vec3 authored = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        authored += point.weight[i] * corners[i].normal_v.xyz;
    authored = mat3(draws[t.draw].normal_matrix) * authored;
    float size = length(authored);
    f.normal = size > 0.0 ? authored / size : facing;
    f.leaves = leaves_of(facing, (m.flags & 1u) != 0u);
    return f;
}

#endif
