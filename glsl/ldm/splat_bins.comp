// Bins photons by tiles of 8 × 8 texels. An invocation owns a tile and a chunk of 256 photons in a row: it goes through the
// chunk in order, so that every tile's list holds its photons in their order, whatever ran first. Once to count, and after
// the prefix sum over values[tile · chunks + chunk] once more to write.
#include "ldm/tiles.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer photons_commands { uint commands[]; };
layout(std430) readonly buffer photons_boxes { uvec2 boxes[]; };
layout(std430) readonly buffer photons_chunks { uvec2 chunks[]; };
layout(std430) buffer prefix_values { uint values[]; }; //! ordered: a stage either writes or reads
layout(std430) writeonly buffer splat_lists { uint splat_list[]; };
// 0: entries of the largest batch · 1: dropped entries
layout(std430) buffer splat_counts { uint counted[]; }; //! ordered: the first invocation alone

uniform int bin_stage;   // 0: count · 1: write
uniform int chunk_count; // that storage is made for

void main() {
    int chunk = int(gl_GlobalInvocationID.x), tile = int(gl_GlobalInvocationID.y);
    if (chunk >= chunk_count || tile >= tile_count()) return;
    int at = tile * chunk_count + chunk;
    uint first = uint(chunk) * 256u, last = min(first + 256u, commands[7]), found = 0u;
    uint place = bin_stage == 1 ? values[at] : 0u, capacity = uint(splat_list.length());
    if (first < last && meets_tile(chunks[chunk], tile)) {
        for (uint i = first; i < last; ++i) {
            if (!meets_tile(boxes[i], tile)) continue;
            if (bin_stage == 1 && place + found < capacity) splat_list[place + found] = i;
            ++found;
        }
    }
    if (bin_stage == 0) values[at] = found;
    if (bin_stage == 1 && at == 0) {
        uint wanted = values[tile_count() * chunk_count];
        counted[0] = max(counted[0], wanted);
        counted[1] += wanted > capacity ? wanted - capacity : 0u;
    }
}
