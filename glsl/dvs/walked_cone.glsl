#ifndef DVS_WALKED_CONE_GLSL
#define DVS_WALKED_CONE_GLSL
// A ray whose direct light comes from reflective shadow maps (voxel/walk_to_hit.glsl): what the voxels cannot resolve is
// resolved where the lights see it. What light bounced between voxels before, and what they emit, is the voxel's at the hit.
// With triangles the ray ends exactly, near by or everywhere, and the maps tell the light of what it meets there.
#if hit >= hit_triangle
#define DVS_HITS_TRIANGLES
#include "surface/map_light.glsl"
#include "surface/start.glsl"
#include "traced/trace.glsl"
#include "voxel/triangle_reach.glsl"
#endif
#include "dvs/cone.glsl"
#include "voxel/walk_to_hit.glsl"

uniform sampler3D dvs_radiance;    //! optional
#if !emitters_apart
uniform sampler3D voxels_emission; //! optional
#endif

Blocker find_blocker(VoxelGrid grid, vec3 apex, vec3 direction, float from) {
    VoxelHit hit = find_blocking_voxel(grid, apex, direction, from);
    return Blocker(hit.t, hit.leaves, hit.voxel);
}

// What a voxel's side sends on but for what the lights' own light makes it send.
vec3 colour_without_lights(ivec3 voxel, bool front) {
    ivec3 size = textureSize(dvs_radiance, 0);
    vec4 direct = texelFetch(dvs_radiance, voxel + ivec3(0, 0, !front && size.z > size.x ? size.x : 0), 0);
    vec3 colour = max(colour_of_side(dvs_base, voxel, front) - direct.rgb, vec3(0.0)), scattered = direct.rgb;
#if emitters_apart
#ifdef HAS_voxels_emission
    scattered = max(scattered - VOXEL_EMISSION(voxel), vec3(0.0));
#endif
#endif
    colour += scattered * max(direct.a - 1.0, 0.0); // from emitters, which no map shows
#if !emitters_apart
#ifdef HAS_voxels_emission
    colour += texelFetch(voxels_emission, voxel, 0).rgb;
#endif
#endif
    return colour;
}

// What a ray brings that ends at `hit`.
Traced cone_to_hit(VoxelGrid grid, ConeStart start, vec3 direction, float diameter, WalkedHit hit) {
    Traced cone = Traced(vec3(0.0), 0.0, 0.0, -1.0);
    if (hit.t < 0.0) return cone;
    ivec3 voxel = hit.voxel;
    uint flags = 0u;
    // What a map's texel shows lies beside its voxel where that ends nearer than a texel is exact.
    const float k_beside[5] = float[](0.0, 0.5, -0.5, 1.0, -1.0);
    for (int i = 0; hit.met && i < 5 && flags == 0u; ++i) {
        vec3 at = (start.surface + hit.t * direction - grid.origin) / grid.voxel + k_beside[i] * direction;
        voxel = clamp(ivec3(floor(at)), ivec3(0), ivec3(grid.resolution - 1));
        flags = texelFetch(voxels_flags, voxel, 0).r;
    }
    if (!hit.met) flags = texelFetch(voxels_flags, voxel, 0).r;
    cone.colour = hit.light;
    if (flags != 0u)
        cone.colour += colour_without_lights(voxel, dot(front_of(texelFetch(voxels_normal, voxel, 0).xyz, flags >> 2), direction) <= 0.0);
    cone.occlusion = 1.0;
    cone.ambient_occlusion = 1.0 / (1.0 + ambient_decay * 0.5 * diameter * hit.t / grid.voxel);
    return cone;
}

#if hit >= hit_triangle
Traced trace_cone_to_triangle(VoxelGrid grid, ConeStart start, StartPoint exact, vec3 direction, float diameter, uint seed) {
    if (dot(direction, exact.face) <= 0.0) return Traced(vec3(0.0), 1.0, 1.0, -1.0); // the surface itself is in the way
    float near = triangle_reach();
    TracedHit met = trace_nearest(exact.origin, direction, near, seed);
    WalkedHit end = WalkedHit(-1.0, false, vec3(0.0), ivec3(0));
    if (met.draw != k_nothing) end = WalkedHit(met.t, true, map_light(exact.origin + met.t * direction, direction), ivec3(0));
#if hit == hit_near_triangle
    else end = walk_on(grid, start, direction, near, near);
#endif
    return cone_to_hit(grid, start, direction, diameter, end);
}
#else
Traced trace_walked_cone(VoxelGrid grid, ConeStart start, vec3 direction, float diameter) {
    return cone_to_hit(grid, start, direction, diameter, walk_to_hit(grid, start, direction));
}
#endif

#endif
