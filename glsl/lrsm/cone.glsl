#ifndef LRSM_CONE_GLSL
#define LRSM_CONE_GLSL
// One cone through occlusion voxels that gathers light from layered reflective shadow maps (LRSM, Eq. 1):
//   I = Σ_i L_i·α_i·Π_{j<i} (1 − α_j).
// hit_then_sample first finds where the cone is blocked, by a thinner cone (where its occlusion passes `hit_threshold`), then
// looks the maps up there once, with the wide cone's sphere, of `hit_radius` voxels at least.
#ifndef SEE_SPHERE // what a view of the cones is told of each sphere; the gather itself keeps nothing
#define SEE_SPHERE(at_hit, centre, t, diameter, alpha, level, share, light)
#endif
uniform bool hit_then_sample = false; //! static the maps are looked up once a cone, where it is blocked
uniform float hit_aperture = 2.0;     //! [0, 90] (degrees) hit_then_sample: of the cone that finds the hit
uniform bool exact_hits = false;      //! static hit_then_sample: the hit is found from voxel to voxel instead of by a thin cone
uniform float hit_radius = 1.5;       //! [0.25, 16] (voxels) hit_then_sample: radius of the sphere that is looked up

uniform int near_spheres = 0;        //! [0, 8] hit_then_sample: spheres looked up between the surface and the cone's start
uniform float near_diameter = 0.5;   //! [0.05, 2] (voxels) of these spheres

uniform int hit_lookup = 0; //! static {layers, map} light at the hit: a sphere in the layers, or from the shadow maps themselves

// Where every cone's light is the maps', nothing reads the layers, and the graph does not make them.
#if hit_then_sample
#if hit_lookup == hit_lookup_map
#define WALKS_OVER_MAPS
#endif
#endif
#include "lrsm/sample.glsl"
#include "voxel/exact_hit.glsl"
#include "voxel/walk_to_hit.glsl"
#ifdef WALKS_OVER_MAPS
#include "surface/sky_bounce.glsl"
#endif

// Where voxels block the cone, from `from` metres on.
OccludedAt find_lit_hit(VoxelGrid grid, vec3 apex, vec3 direction, float from) {
    if (exact_hits) return find_exact_hit(grid, apex, direction, from);
    float t = find_hit_from(grid, apex, direction, 2.0 * tan(radians(0.5 * hit_aperture)), hit_threshold, from);
    return OccludedAt(t, t, t);
}

Blocker find_blocker(VoxelGrid grid, vec3 apex, vec3 direction, float from) {
    OccludedAt hit = find_lit_hit(grid, apex, direction, from);
    return Blocker(hit.t < 0.0 ? -1.0 : hit.enters, hit.leaves, ivec3(0));
}

#ifdef WALKS_OVER_MAPS
ConeLight light_of_walk(VoxelGrid grid, ConeStart start, vec3 direction, WalkedHit hit) {
    if (hit.t < 0.0) return ConeLight(vec3(0.0), 0.0, -1.0);
    vec3 at = start.surface + hit.t * direction;
    if (hit.met) SEE_SPHERE(true, at, hit.t, grid.voxel, 1.0, 0.0, 1.0, hit.light);
    // Where a voxel alone says that the ray is blocked, the surface lies somewhere in it.
    vec3 by_sky = hit.met ? sky_bounce(at, direction, 0.0) : sky_bounce(at + 0.5 * grid.voxel * direction, direction, grid.voxel);
    return ConeLight(hit.light + by_sky, 1.0, hit.t);
}
#endif

// near_spheres look the maps up between the surface and the apex: what is lit and faces the surface counts, and blocks, by the share of
// the sphere that it covers.
ConeLight light_along_cone(VoxelGrid grid, ConeStart start, vec3 direction, float diameter) {
    vec3 light = vec3(0.0), surface = start.surface, apex = start.apex;
#ifdef WALKS_OVER_MAPS
    return light_of_walk(grid, start, direction, walk_to_hit(grid, start, direction));
#else
    if (hit_then_sample) {
        float open = 1.0;
        for (int k = 0; k < near_spheres; ++k) {
            float d = near_diameter * grid.voxel, t = (float(k) + 0.5) * d, blocked = 0.0;
            vec3 sum = vec3(0.0);
            for (int view = 0; view < views.length(); ++view) {
                vec4 lit = sample_lit(view, surface + t * direction, 0.5 * d, -direction);
                sum += lit.rgb;
                blocked = max(blocked, lit.a); // two lights see the same surface
            }
            light += open * sum;
            SEE_SPHERE(false, surface + t * direction, t, d, blocked, 0.0, open * blocked, open * sum);
            open *= 1.0 - blocked;
        }
        float hit = find_lit_hit(grid, apex, direction, max(start_offset, 1.0e-3) * grid.voxel).t;
        if (hit < 0.0) return ConeLight(light, 1.0 - open, -1.0);
        float radius = max(hit_radius * grid.voxel, 0.5 * diameter * hit);
        for (int view = 0; view < views.length(); ++view)
            light += open * sample_view(view, apex + hit * direction, radius, -direction, -1.0);
        SEE_SPHERE(true, apex + hit * direction, hit, 2.0 * radius, 1.0, sphere_level(grid, 2.0 * radius), 1.0, light);
        return ConeLight(light, 1.0, hit);
    }
    float occlusion = 0.0;
    float t = max(start_offset, 1.0e-3) * grid.voxel, end = reach * scene_diagonal;
    for (int i = 0; i < max_steps && t < end && occlusion < 0.99; ++i) {
        vec3 centre = apex + t * direction;
        if (outside_grid(grid, centre)) break;
        float d = max(diameter * t, grid.voxel), level = sphere_level(grid, d), share = 0.0;
        float alpha = sphere_occlusion(grid, centre, direction, level);
        vec3 before = light;
        if (alpha > 1.0e-3) {
            share = (1.0 - occlusion) * alpha;
            for (int view = 0; view < views.length(); ++view)
                light += share * sample_view(view, centre, 0.5 * d, -direction, alpha);
            occlusion += share;
        }
        SEE_SPHERE(false, centre, t, d, alpha, level, share, light - before);
        t += cone_step * d;
    }
    return ConeLight(light, occlusion, -1.0);
#endif
}

#endif
