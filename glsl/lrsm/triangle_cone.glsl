#ifndef LRSM_TRIANGLE_CONE_GLSL
#define LRSM_TRIANGLE_CONE_GLSL
// Rays that triangles block (traced/trace.glsl), and whose light the layers tell at the hit, or the shadow maps themselves.
// With near_triangle that holds for what is near, and beyond it for the voxels of lrsm/cone.glsl; else no occlusion voxels
// are read.
#if hit == hit_near_triangle
#include "lrsm/cone.glsl"
#else
#ifndef SEE_SPHERE
#define SEE_SPHERE(at_hit, centre, t, diameter, alpha, level, share, light)
#endif
uniform int hit_lookup = 0; //! static {layers, map} light at the hit: a sphere in the layers, or from the shadow maps themselves
#if hit_lookup == hit_lookup_map
#define WALKS_OVER_MAPS
#endif
#include "lrsm/sample.glsl"
#include "voxel/cone_steps.glsl"
uniform float hit_radius = 1.5; //! [0.25, 16] (voxels) hit_then_sample: radius of the sphere that is looked up
uniform int map_voxels = 128;   //! [8, 512] hit triangle: what lengths in voxels count in, this many along the grid's side

VoxelGrid cone_grid() {
    return voxel_grid(map_voxels, 1, 1, 0);
}
float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    return 0.0; // nothing gathers occlusion along a ray that triangles block
}
#endif
#ifdef WALKS_OVER_MAPS
#include "surface/sky_bounce.glsl"
#endif
#include "surface/start.glsl"
#include "traced/trace.glsl"
#include "voxel/triangle_reach.glsl"

// Radiance along the ray, and in a whether it is blocked.
vec4 trace_lit_triangles(VoxelGrid grid, ConeStart start, StartPoint exact, vec3 direction, float diameter, uint seed) {
    if (dot(direction, exact.face) <= 0.0) return vec4(0.0, 0.0, 0.0, 1.0); // the surface itself is in the way
    float near = triangle_reach();
    TracedHit met = trace_nearest(exact.origin, direction, near, seed);
    vec3 at = exact.origin + met.t * direction;
    float t = met.t;
#if hit == hit_near_triangle
    if (met.draw == k_nothing) {
#ifdef WALKS_OVER_MAPS
        ConeLight beyond = light_of_walk(grid, start, direction, walk_on(grid, start, direction, near, near));
        return vec4(beyond.radiance, beyond.occlusion);
#else
        t = find_lit_hit(grid, start.apex, direction, near).t;
        if (t < 0.0) return vec4(0.0);
        at = start.apex + t * direction;
#endif
    }
#else
    if (met.draw == k_nothing) return vec4(0.0);
#endif
#ifdef WALKS_OVER_MAPS
    vec3 light = map_light(at, direction) + sky_bounce(at, direction, 0.0);
    SEE_SPHERE(true, at, t, grid.voxel, 1.0, 0.0, 1.0, light);
#else
    vec3 light = vec3(0.0);
    float radius = max(hit_radius * grid.voxel, 0.5 * diameter * t);
    for (int view = 0; view < views.length(); ++view) light += sample_view(view, at, radius, -direction, -1.0);
    SEE_SPHERE(true, at, t, 2.0 * radius, 1.0, sphere_level(grid, 2.0 * radius), 1.0, light);
#endif
    return vec4(light, 1.0);
}

#endif
