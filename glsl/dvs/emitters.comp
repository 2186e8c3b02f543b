// Adds to the light that voxels send on what emissive surfaces send to them, by shadow rays toward points of these, drawn
// by power: V_r += ρ·E/π, on each side of a voxel. Cones would find small emitters by luck. a: 1 (occupied), and the share
// of that in the light that the voxel scatters, for walks, which bring the lights' own (dvs/walked_cone.glsl).
#define WITHOUT_LIGHTS
#include "dvs/emitter_shadow.glsl"
#include "lib/material_model.glsl"
#include "dvs/list.glsl"
#include "dvs/voxel_surface.glsl"

layout(local_size_x = 64) in;

uniform sampler3D voxels_albedo;
uniform sampler3D voxels_emission; //! optional
layout(FORMAT_dvs_radiance) uniform image3D dvs_radiance; //! ordered: each invocation has its own voxel

uniform int points = 2; //! [1, 64] shadow rays per side of a voxel

// Nothing gathers occlusion along these rays.
VoxelGrid cone_grid() {
    return voxel_grid(textureSize(voxels_flags, 0).x, 1, 1, 0);
}
float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    return 0.0;
}

// E/π.
vec3 emitters_at(vec3 centre, vec3 n, uint side) {
    vec3 sum = vec3(0.0);
#ifdef HAS_traced_emitters
    TracedSurface own;
    own.position = centre;
    own.offset = 0.0;
    own.face = own.shading = n;
    for (int i = 0; any_emitters() && i < points; ++i) {
        PixelSampler chances = pixel_sampler(side, uint(i));
        vec3 l;
        sum += emitter_light(own, 0.0, chances, l) / float(points);
    }
#endif
    return sum;
}

void add_to(ivec3 voxel, int layer, vec3 n, int size) {
    vec3 centre = voxel_centre(voxel, size) + surface_offset(voxel) * voxel_grid_side(size) / float(size) * voxel_normal(voxel);
    uint side = hash_combine(uint(voxel.x | (voxel.y << 10) | (voxel.z << 20)), uint(layer));
    vec3 added = emitters_at(centre, n, side) * texelFetch(voxels_albedo, voxel, 0).rgb * mean_diffuse_share();
    ivec3 at = voxel + ivec3(0, 0, layer * size);
    vec3 direct = imageLoad(dvs_radiance, at).rgb, emitted = texelFetch(voxels_emission, voxel, 0).rgb;
    float by_lights = dot(max(direct - emitted, vec3(0.0)), vec3(1.0)), by_emitters = dot(added, vec3(1.0));
    float share = by_emitters > 0.0 ? by_emitters / (by_lights + by_emitters) : 0.0;
    imageStore(dvs_radiance, at, vec4(min(direct + added, vec3(65504.0)), 1.0 + share));
}

void main() {
    uint index = listed_index();
    if (index >= listed) return;
    int size = textureSize(voxels_albedo, 0).x;
    ivec3 voxel = voxel_of(list[index]);
    vec3 n = voxel_normal(voxel);
    add_to(voxel, 0, n, size);
    if (imageSize(dvs_radiance).z > size && voxel_has_back(voxel, n)) add_to(voxel, 1, -n, size);
}
