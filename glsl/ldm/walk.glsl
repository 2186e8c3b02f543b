#ifndef LDM_WALK_GLSL
#define LDM_WALK_GLSL
// Walks through a texel's fragments by depth, however they are stored.
#include "ldm/views.glsl"

layout(std430) readonly buffer ldm_lists { uint lists[]; };
layout(std430) readonly buffer ldm_arrays { uint arrays[]; }; //! optional

// Where the walk stands: lists go by links, arrays from word to word.
struct LdmCursor {
    uint at, end;
};

LdmCursor ldm_first(int head) {
    if (ldm.arrays != 0) return LdmCursor(arrays[head], arrays[head + 1]);
    return LdmCursor(lists[head], 0u);
}
bool ldm_ended(LdmCursor c) {
    return c.at == c.end;
}
// Word of the node: 0 depth, 2 slope, 3 albedo. (Arrays have no links.)
uint ldm_word(LdmCursor c, int word) {
    if (ldm.arrays != 0) return arrays[uint(ldm.heads) + 1u + c.at * uint(ldm.node_words - 1) + uint(max(word - 1, 0))];
    return lists[uint(ldm.heads) + (c.at - 1u) * uint(ldm.node_words) + uint(word)];
}
LdmCursor ldm_next(LdmCursor c) {
    if (ldm.arrays != 0) return LdmCursor(c.at + 1u, c.end);
    return LdmCursor(ldm_word(c, 1), 0u);
}
#endif
