// Ordinates swept upwind: along each direction the planes of cells across its largest component are gone through one after the
// other. A cell takes the radiance of the four cells of the plane before that lie around where its ray comes from, but for those
// whose link to it a surface crosses: what these send ends there. One iteration is one plane of all directions, the outermost
// cascade first; what enters a finer cascade is what the next one has there.
#include "lpv/links.glsl"
#include "lpv/ordinates.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) buffer lpv_ordinates { uvec2 ordinates[]; }; //! ordered: own plane is written, the one before and coarser cascades are read

uniform int iteration;

vec3 light_of(int m, int cascade, ivec3 at) {
    int count = cells_of_cascade();
    return unpacked_light(ordinates[(m * grid_cascades + cascade) * count + int(cell_index(at, grid_size()))]);
}

vec3 light_outside(int m, int cascade, ivec3 at) {
    if (cascade + 1 >= grid_cascades) return vec3(0.0);
    ivec3 there = ivec3(floor(to_cells(cascades[cascade + 1], cell_middle(cascades[cascade], at))));
    return in_grid(there, grid_size()) ? light_of(m, cascade + 1, there) : vec3(0.0);
}

void main() {
    int m = int(gl_GlobalInvocationID.z), cascade = grid_cascades - 1 - iteration / grid_cells, plane = iteration % grid_cells;
    if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), ivec2(grid_cells))) || m >= directions) return;
    vec3 direction = ordinate(m), size = abs(direction);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
    bool forward = direction[axis] > 0.0;
    ivec3 at;
    at[axis] = forward ? plane : grid_cells - 1 - plane;
    at[u] = int(gl_GlobalInvocationID.x);
    at[v] = int(gl_GlobalInvocationID.y);
    // From where in the plane before, in cells from the one straight behind.
    vec2 from = -vec2(direction[u], direction[v]) / size[axis], low = floor(from), share = from - low;
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 4; ++k) {
        ivec2 corner = ivec2(k & 1, k >> 1);
        vec2 bilinear = mix(1.0 - share, share, vec2(corner));
        ivec3 step;
        step[axis] = forward ? -1 : 1;
        step[u] = int(low.x) + corner.x;
        step[v] = int(low.y) + corner.y;
        ivec3 before = at + step;
        float weight = bilinear.x * bilinear.y;
        if (weight <= 0.0) continue;
        if (!in_grid(before, grid_size())) sum += weight * light_outside(m, cascade, before);
        else if (!is_blocked(cascade, at, step)) sum += weight * light_of(m, cascade, before);
    }
    int own = (m * grid_cascades + cascade) * cells_of_cascade() + int(cell_index(at, grid_size()));
    ordinates[own] = packed_light(unpacked_light(ordinates[own]) + sum);
}
