// How many proxies each triangle gets. Their prefix sum gives them their places.
#include "vf/grid.glsl"
#include "vf/triangles.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer vf_grid { Grid grid; };
layout(std430) writeonly buffer prefix_values { uint values[]; };

uniform int triangle_count; // of the buffers, at least as many as are drawn

const uint k_row = 65536u * 32u; // triangles in a row of the dispatch

void main() {
    uint triangle = gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x;
    if (triangle > uint(triangle_count)) return;
    values[triangle] = triangle < draw_starts[draw_count] ? proxies_of(world_triangle(triangle), grid.density) : 0u;
}
