#ifndef DVS_LIST_GLSL
#define DVS_LIST_GLSL
// The occupied voxels as a list, static ones first. An entry is x | y << 9 | z << 18.
layout(std430) buffer voxels_list { uint list[]; };
layout(std430) buffer voxels_counts {
    uvec3 groups;       // of 64 invocations, for an indirect dispatch over the list
    uint listed;        // entries
    uint static_listed; // of them, those of static geometry
    uint homeless;      // voxels for which the list has no room
};

const uint k_groups_a_row = 32768u;
const uint k_static = 1u, k_dynamic = 2u; // the low bits of voxels.flags; above them the six leaves

ivec3 voxel_of(uint entry) {
    return ivec3(entry & 511u, (entry >> 9) & 511u, entry >> 18);
}
uint entry_of(ivec3 voxel) {
    return uint(voxel.x) | (uint(voxel.y) << 9) | (uint(voxel.z) << 18);
}
uint listed_index() {
    return (gl_WorkGroupID.y * k_groups_a_row + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
}

#endif
