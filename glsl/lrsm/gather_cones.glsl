#ifndef LRSM_GATHER_CONES_GLSL
#define LRSM_GATHER_CONES_GLSL
// The cones of one texel of the final gather: where they start, which they are, what each brings. The gather and the
// view of its cones share this, so that what is shown is what is done.
uniform int hit = 1; //! static {voxel, plane, triangle, near_triangle} exact hits: the voxel, half its depth, triangles, these near by
uniform float near_share = 0.05; //! [0.001, 1] (scene diagonals) hit near_triangle: how far triangles count, and voxels beyond
#define CHOOSES_HITS
bool enters_voxels() {
    return hit == hit_voxel;
}
#if hit >= hit_triangle
#include "lrsm/triangle_cone.glsl"
#else
#include "lrsm/cone.glsl"
#endif
#include "surface/gbuffer_surface.glsl"
#include "voxel/cone_set.glsl"
#include "surface/sample_pattern.glsl"

uniform int cone_set = 0;       //! {six, six_tilted, spiral} six as published
uniform int spiral_cones = 32;  //! [4, 128] auto(cones) cones of the set spiral
uniform float aperture = 60.0;  //! [1, 90] (degrees) of each cone, from side to side

struct GatherPoint {
    ConeStart start;
    mat3 frame; // of the surface's normal
    SamplePattern which;
#if hit >= hit_triangle
    StartPoint exact;
    uint seed; // of draws for blended surfaces
#endif
};

// At less than full resolution each texel takes the pixel at its middle.
ivec2 gather_pixel(ivec2 texel, ivec2 size) {
    return min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
}

// False for the background.
bool gather_point(VoxelGrid grid, ivec2 texel, ivec2 pixel, out GatherPoint point) {
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) return false;
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    point.start = cone_start(grid, world_position(pixel, depth), face);
    point.frame = frame_around(n);
    point.which = pattern_at(texel);
#if hit >= hit_triangle
    start_at(pixel, point.exact);
    point.seed = hash_combine(uint(texel.x) | (uint(texel.y) << 16), vary ? uint(frame_index) : 0u);
#endif
    return true;
}

int gather_cone_count() {
    return cone_count(cone_set, spiral_cones);
}

// Radiance along cone i, and in a its occlusion. `cone`: its direction and weight.
vec4 gather_cone(VoxelGrid grid, GatherPoint point, int i, float diameter, out vec4 cone) {
    cone = cone_of(cone_set, spiral_cones, i, point.which.part, point.which.turn);
    cone.xyz = point.frame * cone.xyz;
#if hit >= hit_triangle
    return trace_lit_triangles(grid, point.start, point.exact, cone.xyz, diameter, hash_combine(point.seed, uint(i)) | 1u);
#else
    ConeLight light = light_along_cone(grid, point.start, cone.xyz, diameter);
    return vec4(light.radiance, light.occlusion);
#endif
}

#endif
