// Injection (LPV, section 3.2): each cell's light is the sum of its virtual point lights' lobes. One invocation a cell, in order;
// or what blending made of it in halves, as published.
#include "lpv/grid.glsl"
#include "lpv/light.glsl"

layout(local_size_x = 64) in;

uniform int route = 0; //! static {sorted, blended} sums in the order of the maps, or points that are blended (published)

#if route == route_sorted
layout(std430) readonly buffer lpv_vpls { Vpl vpls[]; };
layout(std430) readonly buffer lpv_light_ranges { uvec2 ranges[]; };
#endif
#if route == route_blended
uniform sampler2D lpv_blended_red;
uniform sampler2D lpv_blended_green;
uniform sampler2D lpv_blended_blue;
#endif
layout(std430) writeonly buffer lpv_light { mat3x4 light[]; };
layout(std430) writeonly buffer lpv_sum { mat3x4 sums[]; };

uniform bool in_result = true; //! the result holds the injected light, too; off: only what was propagated

void main() {
    int cell = int(gl_GlobalInvocationID.x);
    if (cell >= grid_cascades * cells_of_cascade()) return;
    mat3x4 sum = mat3x4(0.0);
    int cascade = cell / cells_of_cascade();
#if route == route_sorted
    uvec2 range = ranges[cell];
    for (uint i = range.x; i < range.y; ++i)
        sum += lobe_about(vpls[i].normal, vpls[i].intensity);
    float side = cascades[cascade].cell;
    sum /= side * side;
#endif
#if route == route_blended
    ivec3 at = cell_of_index(uint(cell % cells_of_cascade()), grid_size());
    ivec2 texel = ivec2(at.z * grid_cells + at.x, cascade * grid_cells + at.y);
    sum = mat3x4(texelFetch(lpv_blended_red, texel, 0), texelFetch(lpv_blended_green, texel, 0), texelFetch(lpv_blended_blue, texel, 0));
#endif
    light[cell] = sum;
    sums[cell] = in_result ? sum : mat3x4(0.0);
}
