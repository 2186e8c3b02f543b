// The proxies in the order of their cells, and where each cell begins and ends: ranges[2·cell] of its own proxies, behind which
// lies ranges[2·cell + 1], copies of those whose discs reach into it.
#include "vf/grid.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer vf_grid { Grid grid; }; //! ordered: what is read was written by earlier passes
layout(std430) readonly buffer vf_emitted { Proxy emitted[]; };
layout(std430) readonly buffer sort_pairs { uvec2 pairs[]; };
layout(std430) writeonly buffer vf_proxies { Proxy proxies[]; };
layout(std430) buffer vf_ranges { uvec2 ranges[]; }; //! ordered: a stage either writes or reads

uniform int entry_capacity;
uniform int sorted_half;
uniform int arrange_stage; // 0: proxies and ranges · 1: the fullest cell

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (arrange_stage == 1) {
        if (i >= uint(grid.count)) return;
        uvec2 own = ranges[2u * i], copies = ranges[2u * i + 1u];
        atomicMax(grid.fullest, own.y - own.x + copies.y - copies.x);
        return;
    }
    if (i >= uint(entry_capacity)) return;
    uint first = uint(sorted_half * entry_capacity), end = 2u * uint(grid.count);
    uvec2 pair = pairs[first + i];
    if (pair.x >= end) {
        proxies[i] = Proxy(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), k_no_cell);
    } else {
        Proxy proxy = emitted[pair.y];
        if ((pair.x & 1u) != 0u) proxy.area = 0.0;
        proxies[i] = proxy;
        if (i == 0u || pairs[first + i - 1u].x != pair.x) ranges[pair.x].x = i;
        if (i + 1u == uint(entry_capacity) || pairs[first + i + 1u].x != pair.x) ranges[pair.x].y = i + 1u;
    }
}
