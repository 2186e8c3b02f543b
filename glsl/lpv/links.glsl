#ifndef LPV_LINKS_GLSL
#define LPV_LINKS_GLSL
// Which links between the centres of cells a surface crosses: 13 bits a cell, for the links of which it is the lowest corner.
#include "lpv/grid.glsl"
#include "lpv/link_bits.glsl"

layout(std430) readonly buffer lpv_links { uint links[]; };

// From a cell to its neighbour at `step`, −1 … 1 along each axis. Both lie in the grid.
bool is_blocked(int cascade, ivec3 from, ivec3 step) {
    if (step == ivec3(0)) return false;
    uint lowest = cell_index(from + min(step, ivec3(0)), grid_size());
    return (links[cascade * cells_of_cascade() + int(lowest)] >> link_bit(step) & 1u) != 0u;
}
#endif
