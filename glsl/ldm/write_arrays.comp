// The lists of a batch as sorted arrays: offsets first, one a texel and one more, then the fragments' words without links.
// A walk goes from word to word instead of jumping about, and a fragment takes 4 bytes less.
#include "ldm/views.glsl"

layout(local_size_x = 256) in;

layout(std430) readonly buffer ldm_lists { uint lists[]; };
layout(std430) readonly buffer prefix_values { uint starts[]; };
layout(std430) writeonly buffer ldm_arrays { uint arrays[]; };

void main() {
    uint heads = uint(ldm.heads), node_words = uint(ldm.node_words);
    for (uint head = gl_GlobalInvocationID.x; head < heads; head += gl_NumWorkGroups.x * 256u) {
        uint start = starts[head], to = heads + 1u + start * (node_words - 1u);
        arrays[head] = start;
        for (uint node = lists[head]; node != 0u;) {
            uint at = heads + (node - 1u) * node_words;
            arrays[to] = lists[at];
            for (uint word = 2u; word < node_words; ++word)
                arrays[to + word - 1u] = lists[at + word];
            to += node_words - 1u;
            node = lists[at + 1u];
        }
    }
    if (gl_GlobalInvocationID.x == 0u) arrays[heads] = starts[heads];
}
