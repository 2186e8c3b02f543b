#ifndef DVS_LIST_GLSL
#define DVS_LIST_GLSL
// The occupied voxels as a list, static ones first. An entry is x | y << 9 | z << 18. For those that read it: who could
// write it would count as one of its makers.
#include "dvs/list_entries.glsl"

layout(std430) readonly buffer voxels_list { uint list[]; };
layout(std430) readonly buffer voxels_counts {
    uvec3 groups;       // of 64 invocations, for an indirect dispatch over the list
    uint listed;        // entries
    uint static_listed; // of them, those of static geometry
    uint overflow;      // voxels that the list cannot hold
};

#endif
