// The scene's area, by one group in a fixed order, and from it the density of proxies: N/A, or less where that is denser than
// `per_face` proxies on an area as large as a cell's side, beyond which they make no list better.
#include "vf/grid.glsl"

layout(local_size_x = 256) in;

layout(std430) readonly buffer vf_areas { float areas[]; };
layout(std430) buffer vf_grid { Grid grid; }; //! ordered: one invocation

uniform int triangle_count;
uniform float per_face = 256.0;  //! [1, 65536] proxies on an area as large as a side of a cell that are enough
uniform float disc_scale = 1.0;  //! [0.25, 16] a disc's area as a multiple of the area that its proxy stands for

shared float sums[256];

void main() {
    uint lane = gl_LocalInvocationID.x;
    float sum = 0.0, lost = 0.0; // Kahan's sum
    for (uint i = lane; i < uint(triangle_count); i += 256u) {
        precise float next = areas[i] - lost;
        precise float higher = sum + next;
        precise float back = higher - sum;
        lost = back - next;
        sum = higher;
    }
    sums[lane] = sum;
    for (uint half_width = 128u; half_width > 0u; half_width /= 2u) {
        barrier();
        if (lane < half_width) sums[lane] += sums[lane + half_width];
    }
    barrier();
    if (lane != 0u) return;
    float area = sums[0], face = (grid.cell.x * grid.cell.y + grid.cell.y * grid.cell.z + grid.cell.z * grid.cell.x) / 3.0;
    float needed = ceil(per_face * area / max(face, 1.0e-20));
    uint used = needed < float(grid.asked) ? uint(needed) : grid.asked;
    grid.area = area;
    grid.density = area > 0.0 ? float(used) / area : 0.0;
    grid.used = used;
    grid.disc_radius = sqrt(disc_scale * area / max(float(used), 1.0) / 3.14159265359);
}
