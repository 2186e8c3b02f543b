// One level of the boxes around triangles (dvs/triangle_bounds.glsl), in voxel units.
#include "voxel/scene_triangles.glsl"
#include "dvs/triangle_bounds.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer voxels_triangle_bounds { vec4 bounds[]; }; //! ordered: a level is written and the finer one read

uniform int level;

void main() {
    int i = int(gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x);
    if (i >= bounds_of_level(level)) return;
    vec3 low = vec3(1.0e30), high = vec3(-1.0e30);
    if (level == 0) {
        VisitedTriangle t = load_triangle(uint(i), draw_starts.length() - 1);
        low = min(t.positions[0], min(t.positions[1], t.positions[2]));
        high = max(t.positions[0], max(t.positions[1], t.positions[2]));
    } else {
        int finer = first_of_level(level - 1), end = min(64 * i + 64, bounds_of_level(level - 1));
        for (int k = 64 * i; k < end; ++k) {
            low = min(low, bounds[2 * (finer + k)].xyz);
            high = max(high, bounds[2 * (finer + k) + 1].xyz);
        }
    }
    int at = first_of_level(level) + i;
    bounds[2 * at] = vec4(low, 0.0);
    bounds[2 * at + 1] = vec4(high, 0.0);
}
