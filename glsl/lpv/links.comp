// Which links between the centres of neighbouring cells the scene's triangles cross. A cube between eight centres is a voxel of a
// grid that is shifted by half a cell; each of a triangle's voxels tests the links that are its own. Bits are only set, so the
// order does not matter.
#include "lpv/grid.glsl"
#include "lpv/link_bits.glsl"

uniform int cascade_index;

#define TO_VOXEL(position) (to_cells(cascades[cascade_index], position) - 0.5)
#include "voxel/triangle_voxels.glsl"

layout(local_size_x = 256) in;

layout(std430) buffer lpv_links { uint links[]; };

// Whether a triangle crosses the stretch from `from` to `from + step`. What touches counts, so that edges are tight.
bool crosses(vec3 a, vec3 b, vec3 c, vec3 from, vec3 step) {
    const float k_slack = 1.0e-4;
    vec3 e1 = b - a, e2 = c - a, p = cross(step, e2);
    float determinant = dot(e1, p);
    if (determinant == 0.0) return false;
    vec3 s = from - a, q = cross(s, e1);
    float u = dot(s, p) / determinant, v = dot(step, q) / determinant, t = dot(e2, q) / determinant;
    return u >= -k_slack && v >= -k_slack && u + v <= 1.0 + k_slack && t >= -k_slack && t <= 1.0 + k_slack;
}

void visit_voxel(VisitedTriangle triangle, ivec3 voxel) {
    uint found = 0u;
    for (int bit = 0; bit < 13; ++bit) {
        ivec3 from, step;
        link_of_bit(bit, from, step);
        if (crosses(triangle.positions[0], triangle.positions[1], triangle.positions[2], vec3(voxel + from), vec3(step))) found |= 1u << bit;
    }
    if (found != 0u) atomicOr(links[cascade_index * cells_of_cascade() + int(cell_index(voxel, grid_size()))], found);
}

void main() {
    visit_triangles();
}
