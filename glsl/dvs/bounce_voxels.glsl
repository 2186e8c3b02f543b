#ifndef DVS_BOUNCE_VOXELS_GLSL
#define DVS_BOUNCE_VOXELS_GLSL
// One bounce of diffuse light between voxels (DVS, section IX): cones about each voxel's averaged normal, times its albedo,
// added to its direct light: L = L_direct + ρ·(E/π). With sky_light, what no cone's voxels block brings the environment's;
// environment_alone: that and nothing else.
#include "lib/environment.glsl"
#include "lib/material_model.glsl"
#include "dvs/cone.glsl"
#include "dvs/list.glsl"
#include "dvs/voxel_surface.glsl"
#include "voxel/cone_set.glsl"

uniform sampler3D voxels_albedo;
uniform sampler3D dvs_radiance; // direct
layout(FORMAT_dvs_bounced) writeonly uniform image3D dvs_bounced;

uniform bool occupied_only;
uniform bool two_sided;
uniform bool environment_alone;
uniform int cone_set = 3;        //! {six, six_tilted, spiral, four} four, as published
uniform int spiral_cones = 4;    //! [1, 64] cones of the set spiral
uniform bool interleave = false; //! neighbouring voxels take different cones: eight sets in turn
uniform bool sky_light = false;  //! static light of the environment, too; off as published
uniform float aperture = 45.0;   //! [1, 90] (degrees) of each cone, from side to side

vec3 gathered(VoxelGrid grid, ivec3 voxel, vec3 n) {
    vec3 apex = voxel_centre(voxel, grid.resolution) + grid.voxel * (surface_offset(voxel) * voxel_normal(voxel) + normal_offset * n);
    mat3 frame = frame_around(n);
    float diameter = 2.0 * tan(radians(0.5 * aperture));
    ivec3 odd = voxel & 1;
    float part = interleave ? (float(odd.x ^ odd.y ^ odd.z) * 4.0 + float(odd.y ^ odd.z) * 2.0 + float(odd.z) + 0.5) / 8.0 : 0.5;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < cone_count(cone_set, spiral_cones); ++i) {
        vec4 cone = cone_of(cone_set, spiral_cones, i, part);
        vec3 direction = frame * cone.xyz;
        Traced traced = trace_cone(grid, apex, direction, diameter, 0.0);
        if (!environment_alone) sum += cone.w * traced.colour;
#if sky_light
        sum += cone.w * (1.0 - traced.occlusion) * environment(direction);
#endif
    }
    return sum;
}

void bounce_voxel() {
    VoxelGrid grid = cone_grid();
    ivec3 voxel;
    if (occupied_only) {
        uint index = listed_index();
        if (index >= listed) return;
        voxel = voxel_of(list[index]);
    } else {
        if (any(greaterThanEqual(gl_GlobalInvocationID, uvec3(grid.resolution)))) return;
        voxel = ivec3(gl_GlobalInvocationID);
        if (texelFetch(voxels_flags, voxel, 0).r == 0u) {
            imageStore(dvs_bounced, voxel, vec4(0.0));
            return;
        }
    }
    vec3 albedo = mean_diffuse_share() * texelFetch(voxels_albedo, voxel, 0).rgb, n = voxel_normal(voxel);
    vec4 direct = texelFetch(dvs_radiance, voxel, 0);
    imageStore(dvs_bounced, voxel, vec4(min(direct.rgb + albedo * gathered(grid, voxel, n), vec3(65504.0)), 1.0));
    if (!two_sided) return;
    ivec3 behind = voxel + ivec3(0, 0, grid.resolution);
    vec3 back = vec3(0.0);
    if (voxel_has_back(voxel, n)) back = texelFetch(dvs_radiance, behind, 0).rgb + albedo * gathered(grid, voxel, -n);
    imageStore(dvs_bounced, behind, vec4(min(back, vec3(65504.0)), 1.0));
}

#endif
