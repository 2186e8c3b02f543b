#ifndef LPV_GRID_GLSL
#define LPV_GRID_GLSL
// The cells of light propagation volumes: nested cascades, the finest first, of as many cells each. passes/lpv/grid.h mirrors the
// structs. Cells are counted from a point that never moves, so that a cell keeps its place and its light when the grid does not.
#include "lib/cell_grid.glsl"

// 32 bytes in std430.
struct Cascade {
    vec3 anchor; // metres: a corner of a cell, the same in every frame
    float cell;  // side of a cell, metres
    ivec3 base;  // the first cell, counted from the anchor
    int padding;
};

layout(std430) readonly buffer lpv_grid {
    int grid_cells; // along each side
    int grid_cascades;
    int grid_follows; // 1: the outermost cascade follows the camera, too
    int grid_padding;
    Cascade cascades[4];
};

ivec3 grid_size() {
    return ivec3(grid_cells);
}
int cells_of_cascade() {
    return grid_cells * grid_cells * grid_cells;
}
// Metres to cells, 0 … grid_cells inside.
vec3 to_cells(Cascade cascade, vec3 x) {
    return (x - cascade.anchor) / cascade.cell - vec3(cascade.base);
}
vec3 cell_middle(Cascade cascade, ivec3 at) {
    return cascade.anchor + cascade.cell * (vec3(cascade.base + at) + 0.5);
}
// The cell of a point that is moved by `offset` cells. The cell's number from the anchor comes first: rounding does not depend on
// where the grid stands.
ivec3 cell_at(Cascade cascade, vec3 x, vec3 offset) {
    return ivec3(floor((x - cascade.anchor) / cascade.cell + offset)) - cascade.base;
}
#endif
