// One pass of a stable radix sort by eight bits of a key. Chunks of 256 pairs: first how often each digit occurs in each
// chunk, then, on top of the prefix sum over digits and chunks, each pair goes to its place. No order of execution matters.
// passes/graph/radix_sort.h runs it.
layout(local_size_x = 256) in;

// key, value; two halves, from one of which pairs go to the other
layout(std430) buffer sort_pairs { uvec2 pairs[]; }; //! ordered: one half is read and the other written
layout(std430) buffer prefix_values { uint values[]; }; //! ordered: a stage either writes or reads

uniform int sort_stage; // 0: count digits · 1: move pairs
uniform int sort_count; // pairs in a half
uniform int sort_shift; // lowest bit of the digit
uniform int sort_half;  // from which pairs come

const uint k_row = 32768u; // chunks in a row of the dispatch

shared uint bins[256];
shared uint digits[256];

void main() {
    uint lane = gl_LocalInvocationID.x, chunk = gl_WorkGroupID.y * k_row + gl_WorkGroupID.x;
    uint count = uint(sort_count), chunks = (count + 255u) / 256u, i = chunk * 256u + lane;
    bool there = i < count && chunk < chunks;
    uvec2 pair = there ? pairs[uint(sort_half) * count + i] : uvec2(0u);
    uint digit = (pair.x >> uint(sort_shift)) & 255u;
    if (sort_stage == 0) {
        bins[lane] = 0u;
        barrier();
        if (there) atomicAdd(bins[digit], 1u);
        barrier();
        if (chunk < chunks) values[lane * chunks + chunk] = bins[lane];
        return;
    }
    digits[lane] = there ? digit : 256u;
    barrier();
    if (!there) return;
    uint before = values[digit * chunks + chunk];
    for (uint k = 0u; k < lane; ++k)
        before += digits[k] == digit ? 1u : 0u;
    pairs[uint(1 - sort_half) * count + before] = pair;
}
