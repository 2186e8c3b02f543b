// Puts the voxels that were marked since the last time on the list, writes what they are (static or dynamic) to the flag
// volume (DVS, section V.B) and their number on the list, plus one, to voxels.place. The order on the list may differ from
// run to run; no volume depends on it. One invocation goes through a brick of 4³ voxels, if voxels.bricks says that one of
// them was written; afterwards it says which bricks hold anything.
#include "dvs/list_build.glsl"
#include "dvs/fixed_point.glsl"

layout(local_size_x = 64) in;

layout(r32ui) uniform uimage3D voxels_place; //! ordered: each invocation has its own brick
layout(r8ui) uniform uimage3D voxels_flags;  //! ordered: each invocation has its own brick
layout(r8ui) uniform uimage3D voxels_bricks; //! ordered: each invocation has its own brick
layout(std430) writeonly buffer voxels_sums { uint sums[]; }; //! optional

uniform uint kind; // k_static or k_dynamic
uniform int averaging; // {average, last_writer, sum, gather}

// The triangle's number, plus one, if the voxel was marked and is not on the list yet.
uint new_mark(ivec3 voxel) {
    return imageLoad(voxels_flags, voxel).r == 0u ? imageLoad(voxels_place, voxel).r : 0u;
}

void main() {
    ivec3 bricks = imageSize(voxels_bricks);
    int at = int(gl_GlobalInvocationID.x);
    if (at >= bricks.x * bricks.y * bricks.z) return;
    ivec3 brick = ivec3(at % bricks.x, at / bricks.x % bricks.y, at / bricks.x / bricks.y);
    int voxels = imageLoad(voxels_bricks, brick).r != 0u ? 64 : 0;
    uint found = 0u;
    bool occupied = false;
    for (int i = 0; i < voxels; ++i) {
        ivec3 voxel = 4 * brick + ivec3(i & 3, (i >> 2) & 3, i >> 4);
        uint mark = new_mark(voxel);
        if (mark != 0u) ++found;
        occupied = occupied || mark != 0u || imageLoad(voxels_flags, voxel).r != 0u;
    }
    if (voxels > 0 && !occupied) imageStore(voxels_bricks, brick, uvec4(0u)); // what moved is gone from here
    uint index = 0u;
    if (found > 0u) index = atomicAdd(listed, found);
    for (int i = 0; i < (found > 0u ? voxels : 0); ++i) {
        ivec3 voxel = 4 * brick + ivec3(i & 3, (i >> 2) & 3, i >> 4);
        uint mark = new_mark(voxel);
        if (mark == 0u) continue;
        if (index >= uint(list.length())) {
            imageStore(voxels_place, voxel, uvec4(0u));
            continue;
        }
        list[index] = entry_of(voxel);
        imageStore(voxels_place, voxel, uvec4(index + 1u));
        imageStore(voxels_flags, voxel, uvec4(kind));
        if (averaging == averaging_last_writer) sums[index] = mark - 1u;
        if (averaging == averaging_sum || averaging == averaging_gather)
            for (uint k = 0u; k < k_sums; ++k)
                sums[index * k_sums + k] = 0u;
        ++index;
    }
}
