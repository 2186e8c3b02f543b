#ifndef LDM_INSERT_GLSL
#define LDM_INSERT_GLSL
// Insertion into pre-sorted per-pixel linked lists (PSPPSLL; Lefebvre, Hornus, Lasram 2014), lock free: the list is in
// order at every moment, and no fragment waits for another.
//
// Why it is correct under concurrency. A node, once linked, is never removed, and its depth never changes; only its link
// does, and only by compare-and-swap. So whoever holds a link's address may go on from it. The new node's words are
// written, then memoryBarrier() orders those stores before the compare-and-swap that publishes its number: an
// invocation that reads the number (coherent, volatile: from memory and not from a register) reads the node's words after
// it, since their address depends on it. If the link changed between reading and swapping, the swap fails, and the search
// goes on from the same link, whose new node may come before or behind ours.
//
// (memoryBarrierBuffer() would do, but zink of Mesa 22.3 makes a barrier of it that waits for the whole work group: in this
// loop, whose invocations end at different steps, lavapipe then drops those that are not done.)
//
// Nodes of one depth are ordered by their other words, so that the content of a list depends on nothing but the fragments.
#include "ldm/views.glsl"

layout(std430) coherent volatile buffer ldm_lists { uint lists[]; };
// 0: nodes asked for in this batch · 1: those of the largest batch · 2: dropped fragments · 3: all fragments
layout(std430) coherent buffer ldm_counts { uint ldm_counted[]; };

uint node_word(uint node, int word) {
    return uint(ldm.heads) + (node - 1u) * uint(ldm.node_words) + uint(word);
}

// Whether the fragment (depth, slope, albedo) comes before a node of the list.
bool comes_before(uvec3 fragment, uint node) {
    uint depth = lists[node_word(node, 0)];
    if (fragment.x != depth || ldm.node_words < 3) return fragment.x < depth;
    uint slope = lists[node_word(node, 2)];
    if (fragment.y != slope || ldm.node_words < 4) return fragment.y < slope;
    return fragment.z < lists[node_word(node, 3)];
}

// fragment: depth's float bits, slope, albedo.
void insert_fragment(uint head, uvec3 fragment) {
    uint node = atomicAdd(ldm_counted[0], 1u) + 1u;
    if (node > uint(ldm.capacity)) return; // counted; the pool grows, and the maps are built again
    lists[node_word(node, 0)] = fragment.x;
    if (ldm.node_words > 2) lists[node_word(node, 2)] = fragment.y;
    if (ldm.node_words > 3) lists[node_word(node, 3)] = fragment.z;
    uint link = head, next = lists[link];
    for (;;) {
        if (next != 0u && !comes_before(fragment, next)) {
            link = node_word(next, 1);
            next = lists[link];
            continue;
        }
        lists[node_word(node, 1)] = next;
        memoryBarrier();
        uint found = atomicCompSwap(lists[link], next, node);
        if (found == next) return;
        next = found;
    }
}
#endif
