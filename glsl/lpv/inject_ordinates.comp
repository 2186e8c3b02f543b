// Injection by ordinates: the radiance that each cell's virtual point lights add along each direction. A beam of the width of a
// cell's face across ω's largest component carries what they send: L = Σ I⟨n·ω⟩⁺ / (s²·max|ω_k|).
#include "lpv/grid.glsl"
#include "lpv/light.glsl"
#include "lpv/ordinates.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer lpv_vpls { Vpl vpls[]; };
layout(std430) readonly buffer lpv_light_ranges { uvec2 ranges[]; };
layout(std430) writeonly buffer lpv_ordinates { uvec2 ordinates[]; };

void main() {
    int cell = int(gl_GlobalInvocationID.x), m = int(gl_GlobalInvocationID.y), count = grid_cascades * cells_of_cascade();
    if (cell >= count || m >= directions) return;
    vec3 direction = ordinate(m), sum = vec3(0.0), size = abs(direction);
    uvec2 range = ranges[cell];
    for (uint i = range.x; i < range.y; ++i)
        sum += vpls[i].intensity * (vpls[i].share * max(dot(vpls[i].normal, direction), 0.0));
    float side = cascades[cell / cells_of_cascade()].cell;
    ordinates[m * count + cell] = packed_light(sum / (side * side * max(size.x, max(size.y, size.z))));
}
