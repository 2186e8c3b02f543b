// Sparse rays from the low-resolution G-buffer (VF, section 3.1): each texel's rays go from cell to cell until they meet a disc,
// and leave that cell in the texel's visibility list. As published, a cell is in the list or not. With `ratio`, a ray goes
// on and tells of every cell in which it crosses a lit disc from its lit side: crossed once, and seen if nothing lies before
// that disc; Σ seen / Σ crossed over all rays of a neighbourhood is the share of the cell's light that is visible.
#include "lib/frame.glsl"
#include "vf/fan.glsl"
#include "vf/list_writer.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform bool ratio = false;  //! a cell's visibility is the share of its light that rays see; off: all of it, as published

// How the ray meets a cell's discs: the nearest of all, and the nearest that sends light back along the ray.
void meet_cell(GridWalk walk, vec3 origin, vec3 direction, out float nearest, out float nearest_lit) {
    nearest = nearest_lit = 3.0e38;
    uvec2 range = entries_of(cell_index(walk.at, grid.size));
    float slack = walk_slack(walk);
    for (uint i = range.x; i < range.y; ++i) {
        float t = meet_disc(proxies[i].position, proxies[i].normal, proxies[i].radius, origin, direction);
        if (t <= skipped * grid.disc_radius) continue;
        if (grid.overlap != 0 && (t < walk.from - slack || t > walk.to + slack)) continue;
        nearest = min(nearest, t);
        if (t < nearest_lit && proxies[i].area > 0.0 && sends_light_to(i, direction)) nearest_lit = t;
    }
}

void march_by_ratio(vec3 origin, vec3 direction) {
    GridWalk walk = start_walk(grid.origin, grid.cell, grid.size, origin, direction);
    float first = 3.0e38;
    while (walk.inside) {
        uint cell = cell_index(walk.at, grid.size);
        // What lies behind the first disc is only asked where there is light.
        if (first > 1.0e38 || cells[cell].c00.a > 0.0) {
            float nearest, nearest_lit;
            meet_cell(walk, origin, direction, nearest, nearest_lit);
            bool open = first > 1.0e38;
            first = min(first, nearest);
            // Discs of one surface lie in one plane, lit ones and others.
            if (nearest_lit < 1.0e38) note_cell(cell, open && nearest_lit <= first + slack * grid.disc_radius ? 1u : 0u, 1u);
        }
        next_cell(walk, grid.size);
    }
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, march_size))) return;
    start_list(texel, 0);
    Fan fan;
    if (fan_at(texel, march_size, fan)) {
        for (int i = 0; i < rays; ++i) {
            vec3 direction;
            if (!fan_direction(fan, i, direction)) continue;
            if (ratio) {
                march_by_ratio(fan.origin, direction);
            } else {
                float t;
                int met = first_disc(fan.origin, direction, 0.0, t);
                if (met >= 0) note_cell(proxies[met].cell, 1u, 1u);
                else atomicAdd(counts[4], 1u);
            }
        }
    }
    finish_list();
}
