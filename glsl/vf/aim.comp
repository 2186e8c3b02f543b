// Rays aimed at what is lit: beside the fan of march.comp each texel asks every n-th cell that holds light, by a ray to one of its
// lit discs, other cells than its neighbours. A cell that is small or far is seldom crossed by the fan, and would be missing
// from all lists of a neighbourhood; these rays count as crossed once, and seen if no disc lies between.
#include "lib/frame.glsl"
#include "vf/fan.glsl"
#include "vf/list_writer.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform int aimed; // n

// One of the cell's discs that sends light to x, or −1: a random one, or one of the next few.
int disc_toward(uint cell, vec3 x, uint salt) {
    uvec2 range = ranges[2u * cell];
    uint count = range.y - range.x;
    if (count == 0u) return -1;
    uint first = uint(unit_hash(uvec3(cell, salt, 0x51u)) * float(count));
    for (uint k = 0u; k < min(count, 8u); ++k) {
        uint i = range.x + (first + k) % count;
        if (sends_light_to(i, proxies[i].position - x)) return int(i);
    }
    return -1;
}

bool reaches(vec3 origin, vec3 direction, float distance_to) {
    GridWalk walk = start_walk(grid.origin, grid.cell, grid.size, origin, direction);
    float last = distance_to - max(slack, 0.01) * grid.disc_radius, t;
    while (walk.inside && walk.from < last) {
        if (first_in_cell(walk, origin, direction, skipped * grid.disc_radius, t) >= 0 && t < last) return false;
        next_cell(walk, grid.size);
    }
    return true;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, march_size))) return;
    Fan fan;
    if (!fan_at(texel, march_size, fan)) return;
    start_list(texel, int(lists[list_start(texel, march_size, list_capacity)]));
    // R2 spreads the n groups of cells evenly over any few neighbours.
    uint salt = uint(texel.x) | uint(texel.y) << 16;
    uint group = min(uint(fract(0.7548776662 * float(texel.x) + 0.5698402910 * float(texel.y)) * float(aimed)), uint(aimed) - 1u);
    for (uint c = group; c < uint(grid.count); c += uint(aimed)) {
        if (cells[c].c00.a <= 0.0) continue;
        int disc = disc_toward(c, fan.origin, salt);
        if (disc < 0) continue;
        vec3 to = proxies[disc].position - fan.origin;
        float away = length(to);
        vec3 direction = to / max(away, 1.0e-12);
        if (dot(direction, fan.face) <= 0.0 || dot(direction, fan.normal) <= 0.0) continue;
        note_cell(c, reaches(fan.origin, direction, away) ? 1u : 0u, 1u);
    }
    finish_list();
}
