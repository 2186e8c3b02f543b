// Exclusive prefix sum over prefix_values in place, in three stages: sums of blocks, their own prefix sum by one group, and
// the blocks' prefix sums on top of it. Integers, so the order of additions does not matter. passes/graph/prefix_sum.h runs
// it.
layout(local_size_x = 256) in;

layout(std430) buffer prefix_values { uint values[]; }; //! ordered: each invocation has its own values
layout(std430) buffer prefix_sums { uint sums[]; };     //! ordered: a stage writes or reads them, or each has its own

uniform int prefix_stage; // 0: sums of blocks · 1: prefix of the sums · 2: prefixes of the values
uniform int prefix_count; // of the values

const uint k_each = 8u; // values an invocation
const uint k_block = 256u * k_each;
const uint k_row = 32768u; // blocks in a row of the dispatch

shared uint partial[256];

// Exclusive prefix sum over the group; `total` of all.
uint group_prefix(uint value, out uint total) {
    uint lane = gl_LocalInvocationID.x;
    partial[lane] = value;
    barrier();
    for (uint step = 1u; step < 256u; step *= 2u) {
        uint left = lane >= step ? partial[lane - step] : 0u;
        barrier();
        partial[lane] += left;
        barrier();
    }
    total = partial[255];
    uint before = partial[lane] - value;
    barrier();
    return before;
}

void main() {
    uint count = uint(prefix_count), lane = gl_LocalInvocationID.x, total;
    if (prefix_stage == 1) {
        uint blocks = (count + k_block - 1u) / k_block, carried = 0u;
        for (uint from = 0u; from < blocks; from += 256u) {
            uint i = from + lane;
            uint before = group_prefix(i < blocks ? sums[i] : 0u, total);
            if (i < blocks) sums[i] = carried + before;
            carried += total;
        }
        return;
    }
    uint block = gl_WorkGroupID.y * k_row + gl_WorkGroupID.x;
    uint first = block * k_block + lane * k_each, own = 0u;
    for (uint i = first; i < first + k_each; ++i)
        if (i < count) own += values[i];
    uint before = group_prefix(own, total);
    if (prefix_stage == 0) {
        if (lane == 0u && block * k_block < count) sums[block] = total;
        return;
    }
    if (block * k_block >= count) return;
    before += sums[block];
    for (uint i = first; i < first + k_each; ++i) {
        if (i >= count) break;
        uint value = values[i];
        values[i] = before;
        before += value;
    }
}
