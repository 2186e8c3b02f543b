#ifndef VF_MARCH_GLSL
#define VF_MARCH_GLSL
// A ray through the cells, and the discs that it meets in each (VF, section 3.1).
#include "lib/frame.glsl"
#include "vf/grid.glsl"

layout(std430) readonly buffer vf_grid { Grid grid; };
layout(std430) readonly buffer vf_ranges { uvec2 ranges[]; };
layout(std430) readonly buffer vf_proxies { Proxy proxies[]; };

// Where a ray meets a disc; below 0: it does not.
float meet_disc(vec3 position, vec3 normal, float radius, vec3 origin, vec3 direction) {
    float along = dot(normal, direction);
    if (abs(along) < 1.0e-6) return -1.0;
    float t = dot(normal, position - origin) / along;
    vec3 off = origin + t * direction - position;
    return t > 0.0 && dot(off, off) <= radius * radius ? t : -1.0;
}

// All entries of a cell: its own proxies, and with overlap the copies of others behind them.
uvec2 entries_of(uint cell) {
    uvec2 own = ranges[2u * cell];
    if (grid.overlap == 0) return own;
    uvec2 copies = ranges[2u * cell + 1u];
    if (copies.y == copies.x) return own;
    return uvec2(own.y > own.x ? own.x : copies.x, copies.y);
}

// How far beyond the walk's cell a hit still counts as in it: a share of the stretch, and of the scene, for corners.
float walk_slack(GridWalk walk) {
    return 1.0e-4 * (walk.to - walk.from) + 2.0e-7 * scene_diagonal;
}

// The disc that the ray meets first in the walk's present cell, or −1. With copies in neighbouring cells a disc counts where
// the ray meets it; else each cell answers for all of its discs, wherever they reach.
int first_in_cell(GridWalk walk, vec3 origin, vec3 direction, float start, out float t) {
    int found = -1;
    t = 3.0e38;
    uvec2 range = entries_of(cell_index(walk.at, grid.size));
    float slack = walk_slack(walk);
    for (uint i = range.x; i < range.y; ++i) {
        float here = meet_disc(proxies[i].position, proxies[i].normal, proxies[i].radius, origin, direction);
        if (here <= start || here >= t) continue;
        if (grid.overlap != 0 && (here < walk.from - slack || here > walk.to + slack)) continue;
        t = here;
        found = int(i);
    }
    return found;
}

// The first disc on a ray's way from cell to cell, or −1: the march stops in the first cell where it meets any. It ends at the
// sides of the grid, which holds the scene: there discs are cut that reach beyond the surfaces at its rim.
int first_disc(vec3 origin, vec3 direction, float start, out float t) {
    GridWalk walk = start_walk(grid.origin, grid.cell, grid.size, origin, direction);
    t = 3.0e38;
    while (walk.inside) {
        int found = first_in_cell(walk, origin, direction, start, t);
        if (found >= 0) return found;
        next_cell(walk, grid.size);
    }
    return -1;
}
#endif
