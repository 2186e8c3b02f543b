// Injection (LPV, section 3.2): each cell's light is the sum of its virtual point lights' lobes. One invocation a cell, in order:
// sums of floats by blending would depend on the precision of the target.
#include "lpv/grid.glsl"
#include "lpv/light.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer lpv_vpls { Vpl vpls[]; };
layout(std430) readonly buffer lpv_light_ranges { uvec2 ranges[]; };
layout(std430) writeonly buffer lpv_light { mat3x4 light[]; };
layout(std430) writeonly buffer lpv_sum { mat3x4 sums[]; };

uniform bool in_result = true; //! the result holds the injected light, too; off: only what was propagated

void main() {
    int cell = int(gl_GlobalInvocationID.x);
    if (cell >= grid_cascades * cells_of_cascade()) return;
    mat3x4 sum = mat3x4(0.0);
    uvec2 range = ranges[cell];
    for (uint i = range.x; i < range.y; ++i)
        sum += lobe_about(vpls[i].normal, vpls[i].intensity);
    float side = cascades[cell / cells_of_cascade()].cell;
    sum /= side * side;
    light[cell] = sum;
    sums[cell] = in_result ? sum : mat3x4(0.0);
}
