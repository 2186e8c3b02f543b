#ifndef VOXEL_SCENE_TRIANGLES_GLSL
#define VOXEL_SCENE_TRIANGLES_GLSL
// The scene's triangles in voxel units, and whether one has a surface in a voxel (lib/triangle_box.glsl). Alpha is looked up
// at the voxel's middle.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#include "lib/scene.glsl"
#include "lib/triangle_box.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"

// The first triangle of each draw, in order; one more entry at the end.
layout(std430) readonly buffer voxels_draw_starts { uint draw_starts[]; };
#define DRAW_START(i) draw_starts[i]
#include "lib/draw_of_triangle.glsl"

uniform int resolution_of_grid;
#ifndef TO_VOXEL // metres to voxels of another grid
#define TO_VOXEL(position) world_to_voxel(position, resolution_of_grid)
#endif

const uint k_row = 65536u; // triangles in a row of the dispatch

// What is needed to find the voxels; the rest is loaded where one is found (triangles of one voxel leave most lanes idle).
struct VisitedTriangle {
    uint index; // over all draws
    int draw;
    uint first; // of its indices
    uint material;
    vec3 positions[3]; // voxel units
};

VisitedTriangle load_triangle(uint triangle, int draw_count) {
    VisitedTriangle t;
    t.index = triangle;
    t.draw = draw_of(triangle, draw_count);
    t.first = draws[t.draw].first_index + 3u * (triangle - draw_starts[t.draw]);
    t.material = draws[t.draw].material;
    mat4 world = draws[t.draw].world;
    for (int i = 0; i < 3; ++i)
        t.positions[i] = TO_VOXEL((world * vec4(vertices[indices[t.first + uint(i)]].position_u.xyz, 1.0)).xyz);
    return t;
}

Vertex[3] corners_of(VisitedTriangle t) {
    return Vertex[3](vertices[indices[t.first]], vertices[indices[t.first + 1u]], vertices[indices[t.first + 2u]]);
}

// The plane's normal, on the authored normals' side; 0 for a triangle without area.
vec3 facing_of(VisitedTriangle t, Vertex corners[3]) {
    vec3 normal = cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]);
    float size = length(normal);
    if (!(size > 0.0)) return vec3(0.0);
    vec3 authored = corners[0].normal_v.xyz + corners[1].normal_v.xyz + corners[2].normal_v.xyz;
    return dot(normal, mat3(draws[t.draw].normal_matrix) * authored) < 0.0 ? -normal / size : normal / size;
}

// Whether the triangle has a surface in the voxel: it overlaps, and is not cut away by its alpha there.
bool triangle_fills(VisitedTriangle t, ivec3 voxel) {
    if (!triangle_overlaps_voxel(t.positions[0], t.positions[1], t.positions[2], voxel)) return false;
    Material material = materials[t.material];
    if (!alpha_matters(material)) return true;
    float alpha = alpha_at(material, corners_of(t), t.positions, vec3(voxel) + 0.5);
    int axis = dominant_axis(cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]));
    return surface_is_there(material, alpha, voxel_place(voxel, axis, uint(t.draw)));
}

#endif
