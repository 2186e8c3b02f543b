// averaging = gather: each voxel that is new on the list goes through the triangles that may lie in it, and sums their
// fragments itself. No other invocation writes its sums, so that there are no atomics, and the sums are those of `sum`.
// A dispatch goes through 8 boxes of 4,096 triangles, so that none loops 65,536 times.
#include "voxel/scene_triangles.glsl"
#include "dvs/list.glsl"
#include "dvs/fixed_point.glsl"
#include "dvs/triangle_fragment.glsl"
#include "dvs/triangle_bounds.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer voxels_triangle_bounds { vec4 bounds[]; };
layout(std430) buffer voxels_sums { uint sums[]; }; //! ordered: each invocation has its own voxel

uniform uint kind;
uniform int first_box; // of 4,096 triangles
uniform float emission_scale;

bool box_meets(int at, ivec3 voxel) {
    vec3 low = bounds[2 * at].xyz, high = bounds[2 * at + 1].xyz; // touching counts
    return all(lessThanEqual(low, vec3(voxel + 1))) && all(greaterThanEqual(high, vec3(voxel)));
}

void main() {
    uint index = listed_index();
    if (index >= listed || (kind == k_dynamic && index < static_listed)) return;
    ivec3 voxel = voxel_of(list[index]);
    int draw_count = draw_starts.length() - 1;
    uint fragments = 0u, leaves = 0u, offset = 0u, area = 0u;
    uvec3 albedo = uvec3(0u), normal = uvec3(0u), emission = uvec3(0u);
    int last_box = min(first_box + 8, bounds_of_level(2)), rows = first_of_level(1), boxes = first_of_level(2);
    for (int box = first_box; box < last_box; ++box) {
        if (!box_meets(boxes + box, voxel)) continue;
        int last_row = min(64 * box + 64, bounds_of_level(1));
        for (int row = 64 * box; row < last_row; ++row) {
            if (!box_meets(rows + row, voxel)) continue;
            int last = min(64 * row + 64, triangle_count);
            for (int i = 64 * row; i < last; ++i) {
                for (bool near = box_meets(i, voxel); near; near = false) {
                    VisitedTriangle t = load_triangle(uint(i), draw_count);
                    vec3 across = cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]);
                    if (!(dot(across, across) > 0.0) || !is_within_floats(across) || !triangle_fills(t, voxel)) continue;
                    VoxelFragment f = fragment_of(t, voxel);
                    ++fragments;
                    albedo += fixed_share(f.albedo);
                    normal += fixed_normal(f.normal);
                    if (emission_scale > 0.0) emission += fixed_emission(f.emission / emission_scale, emission_weight(f));
                    leaves |= f.leaves;
                    offset += fixed_offset(f.offset);
                    area += fixed_area(f.area);
                }
            }
        }
    }
    uint base = index * k_sums;
    sums[base] += fragments;
    for (uint i = 0u; i < 3u; ++i) {
        sums[base + 1u + i] += albedo[i];
        sums[base + 4u + i] += normal[i];
        sums[base + 7u + i] += emission[i];
    }
    sums[base + 10u] |= leaves;
    sums[base + 11u] += offset;
    sums[base + 12u] += area;
}
