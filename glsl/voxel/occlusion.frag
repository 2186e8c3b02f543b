// Occlusion voxels by the rasterizer (LRSM, section 5): each fragment is a column of voxels along the triangle's
// dominant axis, and marks the voxel at its middle (fill = centre, as published: one voxel a column, thinner than the
// triangle) or each voxel of the column that the triangle overlaps (fill = exact). No atomics.
#define SCENE_MATERIALS
#include "lib/material_raster.glsl"
#include "lib/triangle_box.glsl"
#include "voxel/occlusion_store.glsl"

uniform int resolution_of_grid;
uniform int fill = 0;  //! {centre, exact} one voxel per column (published), or every voxel that is overlapped

in Surface {
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;
flat in uint surface_draw;
flat in vec3 surface_a;
flat in vec3 surface_b;
flat in vec3 surface_c;
flat in vec3 surface_facing;

ivec3 unproject(ivec2 plane, int depth, int axis) {
    return axis == 0 ? ivec3(depth, plane) : (axis == 1 ? ivec3(plane.y, depth, plane.x) : ivec3(plane, depth));
}

void main() {
    Material material = materials[surface_material];
    float alpha = sample_base_colour(material, surface_uv(surface.uv), surface.colour).a;
    if (gl_HelperInvocation) return;
    bool both_sides = (material.flags & 1u) != 0u;

    vec3 normal = cross(surface_b - surface_a, surface_c - surface_a);
    int axis = dominant_axis(normal);
    if (normal[axis] == 0.0) return;
    ivec2 column = ivec2(gl_FragCoord.xy);
    // The plane's depth at the column's middle, and how far it changes across the column.
    vec3 across = normal;
    across[axis] = 0.0;
    float depth = surface_a[axis] - dot(across, vec3(unproject(column, 0, axis)) + 0.5 - surface_a) / normal[axis];
    if (fill == fill_centre) {
        ivec3 voxel = unproject(column, int(floor(depth)), axis);
        if (surface_is_there(material, alpha, voxel_place(voxel, axis, surface_draw)))
            store_occlusion(voxel, surface_facing, both_sides, resolution_of_grid);
        return;
    }
    float reach = 0.5 * (abs(normal.x) + abs(normal.y) + abs(normal.z) - abs(normal[axis])) / abs(normal[axis]);
    int last = min(int(floor(depth + reach + 1.0e-3)), resolution_of_grid - 1);
    for (int d = max(int(floor(depth - reach - 1.0e-3)), 0); d <= last; ++d) {
        ivec3 voxel = unproject(column, d, axis);
        if (triangle_overlaps_voxel(surface_a, surface_b, surface_c, voxel) &&
            surface_is_there(material, alpha, voxel_place(voxel, axis, surface_draw)))
            store_occlusion(voxel, surface_facing, both_sides, resolution_of_grid);
    }
}
