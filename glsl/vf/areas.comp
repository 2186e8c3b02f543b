// The area of each triangle in the world.
#include "vf/triangles.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer vf_areas { float areas[]; };

const uint k_row = 65536u * 32u; // triangles in a row of the dispatch

void main() {
    uint triangle = gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x;
    if (triangle < draw_starts[draw_count]) areas[triangle] = world_triangle(triangle).area;
}
