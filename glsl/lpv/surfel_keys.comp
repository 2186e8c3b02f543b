// In which cell of the geometry volume each surfel lies. That volume is shifted by half a cell against the light's.
#include "lpv/grid.glsl"
#include "lpv/surfels.glsl"

layout(local_size_x = 256) in;

layout(std430) writeonly buffer sort_pairs { uvec2 pairs[]; };

uniform int cascade_index;
uniform int entry_count;
uniform int cell_count;

const uint k_row = 65536u * 32u;

void main() {
    uint i = gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x;
    if (i >= uint(entry_count)) return;
    Surfel surfel = surfel_at(int(i));
    uint key = uint(cell_count);
    if (surfel.area > 0.0) {
        ivec3 at = cell_at(cascades[cascade_index], surfel.position, vec3(0.5)), size = grid_size() + 1;
        if (in_grid(at, size)) key = cell_index(at, size);
    }
    pairs[i] = uvec2(key, i);
}
