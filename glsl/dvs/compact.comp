// Puts the voxels that were marked since the last time on the list, writes what they are (static or dynamic) to the flag
// volume (DVS, section V.B) and their number on the list, plus one, to voxels.place. The order on the list may differ from
// run to run; no volume depends on it. A group is a brick of 4³ voxels: voxels.bricks says which hold anything.
#include "dvs/list.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(r32ui) uniform uimage3D voxels_place;
layout(r8ui) uniform uimage3D voxels_flags;
layout(r8ui) writeonly uniform uimage3D voxels_bricks;
layout(std430) buffer voxels_sums { uint sums[]; };            //! optional
layout(std430) buffer voxels_plane_sums { uint plane_sums[]; }; //! optional

uniform uint kind; // k_static or k_dynamic
uniform int averaging; // {average, last_writer, sum, gather}
uniform bool plane_sums_kept; // voxels.plane_sums is there

shared uint found, first, occupied;

void main() {
    if (gl_LocalInvocationIndex == 0u) found = 0u, occupied = 0u;
    barrier();
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    uint mark = 0u;
    if (all(lessThan(voxel, imageSize(voxels_place)))) {
        bool known = imageLoad(voxels_flags, voxel).r != 0u;
        if (!known) mark = imageLoad(voxels_place, voxel).r;
        if (known || mark != 0u) occupied = 1u; // whoever writes it writes the same
    }
    uint mine = mark != 0u ? atomicAdd(found, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u) imageStore(voxels_bricks, ivec3(gl_WorkGroupID), uvec4(occupied));
    if (found == 0u) return;
    if (gl_LocalInvocationIndex == 0u) first = atomicAdd(listed, found);
    barrier();
    if (mark == 0u) return;
    uint index = first + mine;
    if (index >= uint(list.length())) {
        imageStore(voxels_place, voxel, uvec4(0u));
        return;
    }
    list[index] = entry_of(voxel);
    imageStore(voxels_place, voxel, uvec4(index + 1u));
    imageStore(voxels_flags, voxel, uvec4(kind));
    if (averaging == 1) sums[index] = mark - 1u;
    if (averaging == 3) sums[index] = 0u;
    if (averaging == 2)
        for (uint i = 0u; i < 12u; ++i)
            sums[index * 12u + i] = 0u;
    if (plane_sums_kept) plane_sums[2u * index] = plane_sums[2u * index + 1u] = 0u;
}
