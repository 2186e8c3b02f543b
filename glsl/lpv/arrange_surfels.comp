// The surfels in the order of their cells: n·A/s², and which view they are of.
#include "lpv/grid.glsl"
#include "lpv/ranges.glsl"
#include "lpv/surfels.glsl"

layout(local_size_x = 256) in;

layout(std430) writeonly buffer lpv_surfels { vec4 surfels[]; };
layout(std430) writeonly buffer lpv_surfel_ranges { uvec2 ranges[]; };

void main() {
    uint i = own_place();
    if (i >= uint(entry_count)) return;
    uvec2 pair = pair_at(i);
    if (pair.x >= uint(cell_count)) return;
    Surfel surfel = surfel_at(int(pair.y));
    float side = cascades[cascade_index].cell;
    uint place = uint(cascade_index * entry_count) + i, cell = uint(cascade_index * cell_count) + pair.x;
    surfels[place] = vec4(surfel.normal * (surfel.area / (side * side)), float(surfel.view));
    if (begins_cell(i)) ranges[cell].x = place;
    if (ends_cell(i)) ranges[cell].y = place + 1u;
}
