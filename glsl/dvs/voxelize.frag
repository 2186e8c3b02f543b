// Voxelization into albedo, normal and emission by the rasterizer (DVS, section V.A): a fragment is a column of voxels along
// the triangle's dominant axis; outside the triangle's bounding box it is dropped. fill = centre, as published, writes the
// voxel in which the triangle's plane crosses the column's middle; exact: each voxel of the column that it overlaps.
#define SCENE_MATERIALS
#include "lib/material_raster.glsl"
#include "lib/triangle_box.glsl"
#include "dvs/voxel_fragment.glsl"
#include "dvs/fragment_store.glsl"

uniform int resolution_of_grid;
uniform int fill = 0;  //! {centre, exact} raster: one voxel per column (published), or every voxel that is overlapped

in Surface {
    vec3 normal;
    vec4 uv;
    vec4 colour;
} surface;
flat in uint surface_material;
flat in uint surface_triangle;
flat in uint surface_draw;
flat in vec3 surface_a;
flat in vec3 surface_b;
flat in vec3 surface_c;

ivec3 unproject(ivec2 plane, int depth, int axis) {
    return axis == 0 ? ivec3(depth, plane) : (axis == 1 ? ivec3(plane.y, depth, plane.x) : ivec3(plane, depth));
}

void store(ivec3 voxel, VoxelFragment f, vec3 facing) {
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(resolution_of_grid)))) return;
    if (taken_by_static(voxel)) return;
    if (operation == k_mark) {
        store_mark(voxel, surface_triangle);
        return;
    }
    place_fragment(f, surface_a, surface_b, surface_c, facing, voxel);
    store_fragment(voxel, f);
}

void main() {
    Material material = materials[surface_material];
    SurfaceUv uv = surface_uv(surface.uv);
    vec4 base = sample_base_colour(material, uv, surface.colour);
    float metallic = material.metallic * sample_slot(material_metallic_roughness, material.metallic_roughness_texture, uv).b;
    vec3 emission = material.emission * sample_slot(material_emission, material.emission_texture, uv).rgb;
    if (gl_HelperInvocation) return;

    vec3 normal = cross(surface_b - surface_a, surface_c - surface_a);
    int axis = dominant_axis(normal);
    if (normal[axis] == 0.0) return;
    ivec2 column = ivec2(gl_FragCoord.xy);
    vec3 across = normal;
    across[axis] = 0.0;
    vec3 middle = vec3(unproject(column, 0, axis)) + 0.5;
    float depth = surface_a[axis] - dot(across, middle - surface_a) / normal[axis];
    middle[axis] = depth;
    vec3 low = min(surface_a, min(surface_b, surface_c)) - 0.501, high = max(surface_a, max(surface_b, surface_c)) + 0.501;
    vec3 clipped = middle;
    clipped[axis] = clamp(depth, low[axis], high[axis]);
    if (any(lessThan(clipped, low)) || any(greaterThan(clipped, high))) return;

    VoxelFragment f;
    f.albedo = clamp(base.rgb, vec3(0.0), vec3(1.0)) * (1.0 - clamp(metallic, 0.0, 1.0));
    f.emission = emission;
    float size = length(surface.normal);
    vec3 facing = normalize(normal) * (dot(normal, surface.normal) < 0.0 ? -1.0 : 1.0);
    f.normal = size > 0.0 ? surface.normal / size : facing;
    f.leaves = leaves_of(facing, (material.flags & 1u) != 0u);
    if (fill == fill_centre) {
        // Outside the triangle its plane may leave its box.
        float nearest = min(surface_a[axis], min(surface_b[axis], surface_c[axis]));
        float farthest = max(surface_a[axis], max(surface_b[axis], surface_c[axis]));
        ivec3 voxel = unproject(column, int(floor(clamp(depth, nearest, farthest))), axis);
        if (surface_is_there(material, base.a, voxel_place(voxel, axis, surface_draw))) store(voxel, f, facing);
        return;
    }
    float reach = 0.5 * (abs(across.x) + abs(across.y) + abs(across.z)) / abs(normal[axis]);
    for (int d = int(floor(depth - reach - 1.0e-3)); d <= int(floor(depth + reach + 1.0e-3)); ++d) {
        ivec3 voxel = unproject(column, d, axis);
        if (triangle_overlaps_voxel(surface_a, surface_b, surface_c, voxel) &&
            surface_is_there(material, base.a, voxel_place(voxel, axis, surface_draw)))
            store(voxel, f, facing);
    }
}
