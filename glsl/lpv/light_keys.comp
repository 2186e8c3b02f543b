// In which cell the light of each texel of the reflective shadow maps starts (LPV, section 3.2).
#include "lib/frame.glsl"
#include "lpv/start_cell.glsl"

layout(local_size_x = 256) in;

layout(std430) writeonly buffer sort_pairs { uvec2 pairs[]; };
layout(std430) buffer lpv_counts { uint counts[]; };

uniform int cascade_index;
uniform int entry_count;
uniform int cell_count;

const uint k_row = 65536u * 32u;

void main() {
    uint i = gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x;
    if (i >= uint(entry_count)) return;
    ivec3 size = textureSize(rsm_depth, 0);
    ivec3 place = ivec3(int(i) % size.x, int(i) / size.x % size.y, int(i) / (size.x * size.y));
    MapTexel texel = map_texel(place);
    uint key = uint(cell_count);
    if (max(texel.intensity.r, max(texel.intensity.g, texel.intensity.b)) > 0.0) {
        Cascade cascade = cascades[cascade_index];
        ivec3 at = start_cell(cascade, texel, place.z);
        if (in_grid(at, grid_size())) key = cell_index(at, grid_size());
        if (cascade_index == grid_cascades - 1) {
            atomicAdd(counts[0], 1u);
            if (key == uint(cell_count)) atomicAdd(counts[1], 1u);
        }
    }
    pairs[i] = uvec2(key, i);
}
