#ifndef DVS_TRIANGLE_CONE_GLSL
#define DVS_TRIANGLE_CONE_GLSL
// Rays that triangles block (traced/trace.glsl): what the hit itself sends on of the lights' own light, which the shadow maps
// tell, and of what it emits (or, with emitters_apart, of what emitters send it); and what light bounced between voxels before, which is smooth, from the voxel there, for the
// surface's own albedo. With near_triangle that holds for what is near, and beyond it for voxels alone.
#define DVS_HITS_TRIANGLES
#include "dvs/cone.glsl"
#include "traced/light.glsl"
#if emitters_apart
#include "traced/emitter_rays.glsl"
#endif
#include "surface/start.glsl"
#include "voxel/triangle_reach.glsl"

// As images: of samplers there are few.
layout(FORMAT_dvs_radiance) readonly uniform image3D dvs_radiance;
layout(FORMAT_voxels_albedo) readonly uniform image3D voxels_albedo;
layout(FORMAT_dvs_normals) readonly uniform image3D dvs_normals; //! from voxels.normal

// E/π of light that came by way of other voxels. 0 where there is no voxel, or only one bounce is asked for.
vec3 bounced_irradiance(VoxelGrid grid, TracedSurface s) {
    ivec3 voxel = ivec3(0);
    uint flags = 0u;
    const float k_beside[3] = float[](0.0, -0.5, 0.5);
    for (int i = 0; i < 3 && flags == 0u; ++i) {
        voxel = clamp(ivec3(floor((s.position - grid.origin) / grid.voxel + k_beside[i] * s.face)), ivec3(0), ivec3(grid.resolution - 1));
        flags = texelFetch(voxels_flags, voxel, 0).r;
    }
    if (flags == 0u) return vec3(0.0);
    bool front = dot(front_of(imageLoad(dvs_normals, voxel).xyz, flags >> 2), s.face) >= 0.0;
    ivec3 side = voxel + ivec3(0, 0, !front && imageSize(dvs_radiance).z > grid.resolution ? grid.resolution : 0);
    vec3 bounced = max(texelFetch(DVS_BASE, side, 0).rgb - imageLoad(dvs_radiance, side).rgb, vec3(0.0));
    return bounced / max(mean_diffuse_share() * imageLoad(voxels_albedo, voxel).rgb, vec3(0.02));
}

Traced trace_triangle_cone(VoxelGrid grid, ConeStart start, StartPoint exact, vec3 direction, float diameter, uint seed) {
    Traced cone = Traced(vec3(0.0), 0.0, 0.0, -1.0);
    cone.occlusion = cone.ambient_occlusion = 1.0;
    if (dot(direction, exact.face) <= 0.0) return cone; // the surface itself is in the way
    float near = triangle_reach();
    TracedHit met = trace_nearest(exact.origin, direction, near, seed);
    float t = met.t;
    if (met.draw != k_nothing) {
#if emitters_apart
        TracedSurface s = surface_at(met, direction, 0);
        cone.colour = scattered_light(s, -direction, true, seed);
#ifdef HAS_traced_emitters
        if (any_emitters()) {
            PixelSampler chances = pixel_sampler(seed, 0u);
            vec3 l, light = emitter_light(s, 0.0, chances, l);
            cone.colour += light * k_pi * diffuse_lobe(s.shading, -direction, l, s.base_colour, s.metallic, s.roughness);
        }
#endif
#else
        TracedSurface s = surface_at(met, direction, k_with_emission);
        cone.colour = s.emission + scattered_light(s, -direction, true, seed);
#endif
        vec3 bounced = bounced_irradiance(grid, s);
        if (bounced != vec3(0.0)) cone.colour += bounced * diffuse_albedo(s.base_colour, s.metallic, s.roughness, dot(s.shading, -direction));
    } else {
#if hit == hit_near_triangle
        VoxelHit beyond = find_blocking_voxel(grid, start.apex, direction, near);
        t = beyond.t;
        if (t < 0.0) return Traced(vec3(0.0), 0.0, 0.0, -1.0);
        cone.colour = colour_at_hit(beyond.voxel, beyond.walk.front);
#else
        return Traced(vec3(0.0), 0.0, 0.0, -1.0);
#endif
    }
    cone.ambient_occlusion = 1.0 / (1.0 + ambient_decay * 0.5 * diameter * t / grid.voxel);
    return cone;
}

#endif
