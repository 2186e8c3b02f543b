#ifndef LPV_RANGES_GLSL
#define LPV_RANGES_GLSL
// Entries of many cells, sorted by cells: where those of each cell begin and end. passes/lpv/cell_sort.h runs what includes it.
layout(std430) readonly buffer sort_pairs { uvec2 pairs[]; }; // cell, entry; two halves

uniform int sorted_half;
uniform int entry_count;
uniform int cell_count;    // of a cascade; entries of no cell have it as theirs
uniform int cascade_index; // which is being sorted

const uint k_row = 65536u * 32u; // entries in a row of the dispatch

uint own_place() {
    return gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x;
}
uvec2 pair_at(uint place) {
    return pairs[uint(sorted_half * entry_count) + place];
}
bool begins_cell(uint place) {
    return place == 0u || pair_at(place - 1u).x != pair_at(place).x;
}
bool ends_cell(uint place) {
    return place + 1u == uint(entry_count) || pair_at(place + 1u).x != pair_at(place).x;
}
#endif
