// The list of dvs/list.glsl, for the programs of the voxelization that make it.
#include "dvs/list_entries.glsl"

layout(std430) buffer voxels_list { uint list[]; };
layout(std430) buffer voxels_counts { //! ordered: one invocation reads what others wrote before
    uvec3 groups;       // of 64 invocations, for an indirect dispatch over the list
    uint listed;        // entries
    uint static_listed; // of them, those of static geometry
    uint overflow;      // voxels that the list cannot hold
};
