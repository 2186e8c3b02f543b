#ifndef VOXEL_TRIANGLE_VOXELS_GLSL
#define VOXEL_TRIANGLE_VOXELS_GLSL
// Visits exactly the voxels that each triangle overlaps, without a rasterizer. Sixteen invocations share a triangle and take
// the columns along its dominant axis in turn (so that none loops 65,536 times at 512³, where some software drivers cut
// loops off). A shader includes this file, defines visit_voxel (before, SKIP_VOXEL, if some are left out), and calls
// visit_triangles from a group of 256.
#ifndef SKIP_VOXEL
#define SKIP_VOXEL(voxel) false
#endif
#include "voxel/scene_triangles.glsl"

const int k_lanes = 16; // invocations a triangle

vec2 plane_of(vec3 p, int axis) {
    return axis == 0 ? p.yz : (axis == 1 ? p.zx : p.xy);
}
ivec3 unproject(ivec2 plane, int depth, int axis) {
    return axis == 0 ? ivec3(depth, plane) : (axis == 1 ? ivec3(plane.y, depth, plane.x) : ivec3(plane, depth));
}

void visit_voxel(VisitedTriangle triangle, ivec3 voxel);

void visit_triangles() {
    int draw_count = draw_starts.length() - 1;
    uint triangle = gl_GlobalInvocationID.y * k_row + gl_GlobalInvocationID.x / uint(k_lanes);
    if (draw_count < 1 || triangle >= draw_starts[draw_count]) return;
    VisitedTriangle t = load_triangle(triangle, draw_count);
    vec3 p[3] = t.positions;
    vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (!(dot(normal, normal) > 0.0) || !is_within_floats(normal)) return;

    // The box around the triangle, as far as it lies in the grid. Touching counts, so a corner on a border belongs to both
    // sides.
    float outside = float(resolution_of_grid) + 1.0;
    vec3 least = clamp(min(p[0], min(p[1], p[2])), -1.0, outside), most = clamp(max(p[0], max(p[1], p[2])), -1.0, outside);
    ivec3 low = max(ivec3(ceil(least)) - 1, ivec3(0));
    ivec3 high = min(ivec3(floor(most)), ivec3(resolution_of_grid - 1));
    if (any(lessThan(high, low))) return;
    int axis = dominant_axis(normal);
    ivec2 plane_low = ivec2(plane_of(vec3(low), axis)), plane_high = ivec2(plane_of(vec3(high), axis));
    int width = plane_high.x - plane_low.x + 1, columns = width * (plane_high.y - plane_low.y + 1);
    int lane = int(gl_GlobalInvocationID.x) % k_lanes;
    if (lane >= columns) return;

    vec3 across = normal;
    across[axis] = 0.0;
    float reach = 0.5 * (abs(across.x) + abs(across.y) + abs(across.z)) / abs(normal[axis]) + 1.0e-3;
    for (int i = lane; i < columns; i += k_lanes) {
        ivec2 column = plane_low + ivec2(i % width, i / width);
        vec3 middle = vec3(unproject(column, 0, axis)) + 0.5;
        float depth = clamp(p[0][axis] - dot(across, middle - p[0]) / normal[axis], -4.0, outside + 4.0);
        int from = max(int(floor(depth - reach)), low[axis]), to = min(int(floor(depth + reach)), high[axis]);
        for (int d = from; d <= to; ++d) { // at most four: the slopes are at most 1
            ivec3 voxel = unproject(column, d, axis);
            if (SKIP_VOXEL(voxel) || !triangle_fills(t, voxel)) continue;
            visit_voxel(t, voxel);
        }
    }
}

#endif
