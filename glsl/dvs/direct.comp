// Light that voxels send on (DVS, section VI), over all lights:
//   V_r = Σ L_i·(ρ/π)·max(N·Ψ, 0)·ν + L_e  (Eq. 2),   L_i: irradiance at normal incidence, Ψ: toward the light,
// or with the normal-weighted attenuation (Eq. 3–5): D_ω = max(±Ψ_ω, 0) by the sign of N_ω, W = N²,
//   V_r = Σ L_i·(ρ/π)·(W_x·D_x + W_y·D_y + W_z·D_z)·ν + L_e.
// ν by shadow map, at V_p + N·V_size/2 (section VI.C), or by a ray through the voxels: hard, or soft,
//   ν ← ν + (1 − ν)·κ/t, t in voxels, of which 1 − ν is left.
// ρ is the diffuse lobe's albedo for light from Ψ (lib/material_model.glsl).
#define SCENE_LIGHTS
#include "lib/material_model.glsl"
#include "lib/scene.glsl"
#include "lib/shadow.glsl"
#include "dvs/list.glsl"
#include "dvs/attenuation.glsl"
#include "dvs/voxel_surface.glsl"

layout(local_size_x = 64) in;

uniform sampler3D voxels_albedo;
uniform sampler3D voxels_emission;  //! optional
uniform sampler2DArray shadow_depth;  //! optional
layout(std430) readonly buffer shadow_views { ShadowView views[]; };  //! optional
layout(FORMAT_dvs_radiance) writeonly uniform image3D dvs_radiance;

uniform bool occupied_only;
uniform bool two_sided;
uniform float emission_scale;
uniform int attenuation = 0;         //! {lambert, normal_weighted} Eq. 2, or Eq. 3–5
uniform int occlusion = 0;           //! {shadow_map, ray_hard, ray_soft, none} what tells which voxels a light reaches
uniform float shadow_shift = 0.5;    //! [0, 4] (voxels) how far along the normal a voxel is moved before its look-up: ½ as published
uniform int shadow_filter = 0;       //! [0, 3] shadow_map: points per side looked up over the voxel's width; 0: one point
uniform float ray_start = 1.5;       //! [0.5, 8] (voxels) where a ray starts, past the voxel itself
uniform float ray_step = 1.0;        //! [0.25, 2] (voxels) from sample to sample of a ray
uniform float kappa = 0.5;           //! [0, 4] κ: what a collision one voxel away adds to a soft ray's occlusion

float seen_in_map(Light light, vec3 p) {
    int layer = shadow_layer(light, p);
    ShadowView view = views[layer];
    vec4 clip = view.view_projection * vec4(p, 1.0);
    if (clip.w <= 0.0) return 1.0;
    vec2 uv = clip.xy / clip.w * 0.5 + 0.5;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return 1.0;
    ivec2 size = textureSize(shadow_depth, 0).xy;
    float depth = texelFetch(shadow_depth, ivec3(clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1), layer), 0).r;
    return shadow_distance(view, depth) >= dot(p - view.origin, view.direction) ? 1.0 : 0.0;
}

float map_visibility(Light light, vec3 p, vec3 n, float voxel) {
    if (light.shadow_base < 0) return 1.0;
    if (shadow_filter == 0) return seen_in_map(light, p);
    vec3 t = normalize(abs(n.y) < 0.9 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
    vec3 b = cross(n, t);
    int side = shadow_filter + 1;
    float seen = 0.0;
    for (int i = 0; i < side * side; ++i) {
        vec2 at = (vec2(i % side, i / side) + 0.5) / float(side) - 0.5;
        seen += seen_in_map(light, p + voxel * (at.x * t + at.y * b));
    }
    return seen / float(side * side);
}

float ray_visibility(vec3 from, vec3 l, float distance, float voxel, int size) {
    vec3 p = from / voxel; // voxel units
    float end = min(distance / voxel - 1.0, 2.0 * float(size));
    float occluded = 0.0;
    for (float t = ray_start; t < end; t += ray_step) {
        ivec3 at = ivec3(floor(p + t * l));
        if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, ivec3(size)))) break;
        if (texelFetch(voxels_flags, at, 0).r == 0u) continue;
        if (occlusion == occlusion_ray_hard) return 0.0;
        occluded += (1.0 - occluded) * min(kappa / t, 1.0);
        if (occluded > 0.99) return 0.0;
    }
    return 1.0 - occluded;
}

vec3 voxel_light(ivec3 voxel, vec3 n, vec3 albedo, int size) {
    float side = voxel_grid_side(size), width = side / float(size);
    vec3 centre = voxel_centre(voxel, size) + surface_offset(voxel) * width * voxel_normal(voxel), sum = vec3(0.0);
    for (int i = 0; i < light_count; ++i) {
        vec3 l;
        vec3 irradiance = light_irradiance(lights[i], centre, l);
        float cosine = attenuation == attenuation_lambert ? max(dot(n, l), 0.0) : normal_weighted(texelFetch(voxels_normal, voxel, 0).xyz, n, l);
        if (cosine <= 0.0 || max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0) continue;
        vec3 moved = centre + n * (shadow_shift * width);
        float seen = 1.0;
        if (occlusion == occlusion_shadow_map) {
            seen = map_visibility(lights[i], moved, n, width);
        } else if (occlusion != occlusion_none) {
            bool far = lights[i].type == k_light_directional;
            float distance = far ? 4.0 * side : length(lights[i].position - centre);
            seen = ray_visibility(centre - voxel_grid_origin(side), l, distance, width, size);
        }
        sum += irradiance * (cosine * seen * diffuse_share(dot(n, l)));
    }
    return sum * albedo / 3.14159265359;
}

void main() {
    int size = textureSize(voxels_albedo, 0).x;
    ivec3 voxel;
    if (occupied_only) {
        uint index = listed_index();
        if (index >= listed) return;
        voxel = voxel_of(list[index]);
    } else {
        uint at = gl_GlobalInvocationID.x;
        voxel = ivec3(at % uint(size), gl_GlobalInvocationID.y, gl_GlobalInvocationID.z);
        if (any(greaterThanEqual(uvec3(gl_GlobalInvocationID), uvec3(size)))) return;
        if (texelFetch(voxels_flags, voxel, 0).r == 0u) {
            imageStore(dvs_radiance, voxel, vec4(0.0));
            return;
        }
    }
    vec3 albedo = texelFetch(voxels_albedo, voxel, 0).rgb, n = voxel_normal(voxel);
    vec3 emitted = emission_scale > 0.0 ? texelFetch(voxels_emission, voxel, 0).rgb : vec3(0.0);
    imageStore(dvs_radiance, voxel, vec4(min(emitted + voxel_light(voxel, n, albedo, size), vec3(65504.0)), 1.0));
    if (!two_sided) return;
    vec3 back = voxel_has_back(voxel, n) ? emitted + voxel_light(voxel, -n, albedo, size) : vec3(0.0);
    imageStore(dvs_radiance, voxel + ivec3(0, 0, size), vec4(min(back, vec3(65504.0)), 1.0));
}
