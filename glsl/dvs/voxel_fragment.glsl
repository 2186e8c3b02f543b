#ifndef DVS_VOXEL_FRAGMENT_GLSL
#define DVS_VOXEL_FRAGMENT_GLSL
// A fragment: what a triangle's surface is inside a voxel. ρ = base colour·(1 − metallic), the shading normal as authored,
// emission, the leaves that it faces, and where its plane lies.
#include "lib/polygon_box.glsl"

struct VoxelFragment {
    vec3 albedo;
    vec3 normal; // unit
    vec3 emission;
    uint leaves; // bit 2·axis faces +axis, the next −axis
    float offset; // of the triangle's plane from the voxel's centre, along its own normal (voxels)
    float area; // of what emits, inside the voxel (voxels²)
};

#ifdef HAS_voxels_emission
const bool k_emission = true; // something in the scene emits
#else
const bool k_emission = false;
#endif

uniform int emission_share = 0; //! static {mean, covered} emission: mean over triangles, or by the covered share of the voxel's plane

uniform float leaf_threshold = 0.3; //! [0, 1] directional leaves: the cosine to an axis from which a surface blocks along it

uint leaves_of(vec3 facing, bool both_sides) {
    uint leaves = 0u;
    for (int axis = 0; axis < 3; ++axis) {
        if (facing[axis] > leaf_threshold || (both_sides && -facing[axis] > leaf_threshold)) leaves |= 1u << (2 * axis);
        if (-facing[axis] > leaf_threshold || (both_sides && facing[axis] > leaf_threshold)) leaves |= 2u << (2 * axis);
    }
    return leaves;
}

// `facing`: unit, on the side of the authored normal.
void place_fragment(inout VoxelFragment f, vec3 a, vec3 b, vec3 c, vec3 facing, ivec3 voxel) {
    f.offset = dot(facing, a - (vec3(voxel) + 0.5));
    f.area = 0.0;
    if (k_emission && emission_share == emission_share_covered && f.emission != vec3(0.0)) f.area = triangle_area_in_voxel(a, b, c, voxel);
}
float emission_weight(VoxelFragment f) {
    return emission_share == emission_share_covered ? f.area : 1.0;
}

#endif
