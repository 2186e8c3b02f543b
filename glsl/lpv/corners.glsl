#ifndef LPV_CORNERS_GLSL
#define LPV_CORNERS_GLSL
// Which cells a point takes its light from (LPV, section 3.5): the eight around its place, moved along its normal by half a cell,
// and which cascade they are of.
#include "lpv/grid.glsl"

uniform float shift = 0.5;     //! [0, 1] (cells) how far a point is moved along its normal
uniform float fade = 0.2;      //! [0, 1] where a cascade fades into the next, as a share of its half width
uniform bool in_front = false; //! static cells behind the point's surface, or behind a link that is crossed, do not count

#if in_front
#include "lpv/links.glsl"
#endif

struct Corners {
    ivec3 low;
    float weight[8];
};

ivec3 corner_cell(Corners corners, int k) {
    return clamp(corners.low + ivec3(k & 1, k >> 1 & 1, k >> 2), ivec3(0), grid_size() - 1);
}

// `place`: in cells.
Corners corners_at(vec3 place) {
    Corners corners;
    corners.low = ivec3(floor(place - 0.5));
    vec3 share = place - 0.5 - vec3(corners.low);
    for (int k = 0; k < 8; ++k) {
        vec3 weight = mix(1.0 - share, share, vec3(k & 1, k >> 1 & 1, k >> 2));
        corners.weight[k] = weight.x * weight.y * weight.z;
    }
    return corners;
}

#if in_front
// What is left is scaled to one. Where nothing is, all eight count.
void leave_out_hidden(inout Corners corners, int cascade, vec3 x, vec3 n) {
    int own = -1;
    float most = 0.0, total = 0.0, kept[8];
    for (int k = 0; k < 8; ++k) {
        kept[k] = dot(cell_middle(cascades[cascade], corner_cell(corners, k)) - x, n) > 0.0 ? corners.weight[k] : 0.0;
        if (kept[k] > most) most = kept[k], own = k;
    }
    if (own < 0) return;
    ivec3 from = corner_cell(corners, own);
    for (int k = 0; k < 8; ++k) {
        if (kept[k] > 0.0 && is_blocked(cascade, from, corner_cell(corners, k) - from)) kept[k] = 0.0;
        total += kept[k];
    }
    for (int k = 0; k < 8; ++k)
        corners.weight[k] = kept[k] / total;
}
#endif

// The share of a point's light that comes from this cascade.
float share_of_cascade(int cascade, vec3 x) {
    vec3 place = to_cells(cascades[cascade], x), half_width = vec3(0.5 * float(grid_cells)), off = abs(place - half_width);
    float inside = half_width.x - max(off.x, max(off.y, off.z)), width = fade * half_width.x;
    // Behind a grid that holds the scene there is nothing to fade into.
    if (cascade == grid_cascades - 1 && grid_follows == 0) return inside > -1.0 ? 1.0 : 0.0;
    return width > 0.0 ? clamp(inside / width, 0.0, 1.0) : step(0.0, inside);
}
#endif
