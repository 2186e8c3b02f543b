#ifndef DVS_VOXEL_FRAGMENT_GLSL
#define DVS_VOXEL_FRAGMENT_GLSL
// A fragment: what a triangle's surface is inside a voxel. ρ = base colour·(1 − metallic), the shading normal as authored,
// emission, and the leaves that it faces.
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

#endif
