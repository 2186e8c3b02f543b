// The texels of the reflective shadow maps as virtual point lights, in the order of their cells. What lies in one cell keeps the
// order of the maps' texels, so that sums are the same in every run.
#include "lib/frame.glsl"
#include "surface/map_texel.glsl"
#include "lpv/grid.glsl"
#include "lpv/light.glsl"
#include "lpv/ordinates.glsl"
#include "lpv/ranges.glsl"

layout(local_size_x = 256) in;

layout(std430) writeonly buffer lpv_vpls { Vpl vpls[]; };
layout(std430) writeonly buffer lpv_light_ranges { uvec2 ranges[]; };

void main() {
    uint i = own_place();
    if (i >= uint(entry_count)) return;
    uvec2 pair = pair_at(i);
    if (pair.x >= uint(cell_count)) return;
    ivec3 size = textureSize(rsm_depth, 0);
    int entry = int(pair.y);
    MapTexel texel = map_texel(ivec3(entry % size.x, entry / size.x % size.y, entry / (size.x * size.y)));
    uint place = uint(cascade_index * entry_count) + i, cell = uint(cascade_index * cell_count) + pair.x;
    float cosines = 0.0;
    for (int m = 0; m < directions; ++m)
        cosines += max(dot(texel.normal, ordinate(m)), 0.0);
    vpls[place] = Vpl(texel.normal, directions > 0 ? 0.25 * float(directions) / max(cosines, 1.0e-6) : 1.0, texel.intensity, 0.0);
    if (begins_cell(i)) ranges[cell].x = place;
    if (ends_cell(i)) ranges[cell].y = place + 1u;
}
