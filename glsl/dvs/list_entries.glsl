#ifndef DVS_LIST_ENTRIES_GLSL
#define DVS_LIST_ENTRIES_GLSL
// What entries of the list of occupied voxels are.

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
