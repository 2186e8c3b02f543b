// In which cells each proxy is found: its own, and with `overlap` those that its disc's box reaches into. First how many, then,
// on top of their prefix sum, a pair (2·cell + (1 if a copy), proxy) for each.
#include "vf/grid.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer vf_grid { Grid grid; }; //! ordered: what is read was written by earlier passes
layout(std430) readonly buffer vf_emitted { Proxy emitted[]; };
layout(std430) buffer prefix_values { uint values[]; }; //! ordered: a stage either writes or reads
layout(std430) writeonly buffer sort_pairs { uvec2 pairs[]; };

uniform int entry_stage; // 0: count · 1: write · 2: keys that sort behind all others into what is left
uniform int proxy_capacity;
uniform int entry_capacity;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (entry_stage == 2) {
        uint total = values[proxy_capacity];
        if (i == 0u) {
            grid.entries = total;
            grid.dropped_entries = total > uint(entry_capacity) ? total - uint(entry_capacity) : 0u;
        }
        if (i >= total && i < uint(entry_capacity)) pairs[i] = uvec2(2u * uint(grid.count), 0u);
        return;
    }
    if (i >= uint(proxy_capacity)) {
        if (i == uint(proxy_capacity) && entry_stage == 0) values[i] = 0u;
        return;
    }
    Proxy proxy = emitted[i];
    uint found = 0u;
    if (proxy.cell != k_no_cell) {
        ivec3 own = cell_of_index(proxy.cell, grid.size), low = own, high = own;
        if (grid.overlap != 0) {
            // The box around a disc: r·√(1 − n²) along each axis.
            vec3 reach = proxy.radius * sqrt(max(1.0 - proxy.normal * proxy.normal, 0.0));
            low = clamp(ivec3(floor((proxy.position - reach - grid.origin) / grid.cell)), ivec3(0), grid.size - 1);
            high = clamp(ivec3(floor((proxy.position + reach - grid.origin) / grid.cell)), ivec3(0), grid.size - 1);
        }
        uint place = entry_stage == 1 ? values[i] : 0u;
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    uint cell = cell_index(ivec3(x, y, z), grid.size), at = place + found++;
                    if (entry_stage == 1 && at < uint(entry_capacity)) pairs[at] = uvec2(2u * cell + (cell == proxy.cell ? 0u : 1u), i);
                }
    }
    if (entry_stage == 0) values[i] = found;
}
