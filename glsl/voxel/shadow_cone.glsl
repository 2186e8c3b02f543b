#ifndef VOXEL_SHADOW_CONE_GLSL
#define VOXEL_SHADOW_CONE_GLSL
// Soft shadows from any cone source (Crassin et al. 2011; LRSM, section 6; DVS, section VIII.C): for each pixel and light the
// share of a cone toward the light that nothing blocks. Layer i of the result is light i.
#define SCENE_LIGHTS
#include "lib/scene.glsl"
#include "voxel/cone_steps.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_voxels_light_visibility) writeonly uniform image2DArray voxels_light_visibility; //! neutral 1

uniform float aperture = 3.0; //! [0.1, 45] (degrees) of the cone, from side to side

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(voxels_light_visibility))) || at.z >= light_count) return;
    float depth = texelFetch(gbuffer_depth, at.xy, 0).r;
    float open = 1.0;
    if (depth > 0.0) {
        VoxelGrid grid = cone_grid();
        vec3 position = world_position(at.xy, depth);
        vec3 face = normalize(texelFetch(gbuffer_geometric_normal, at.xy, 0).xyz);
        vec3 l;
        light_irradiance(lights[at.z], position, l);
        float end = lights[at.z].type == k_light_directional ? reach * scene_diagonal : min(length(lights[at.z].position - position), reach * scene_diagonal);
        vec3 apex = cone_start(grid, position, face).apex;
        float diameter = 2.0 * tan(radians(0.5 * aperture));
        float t = max(start_offset, 1.0e-3) * grid.voxel;
        for (int i = 0; i < max_steps && open > 0.01; ++i) {
            float d = max(diameter * t, grid.voxel);
            // The light itself is no occluder, nor what it hangs on.
            if (t + 0.5 * d >= end) break;
            open *= 1.0 - sphere_occlusion(grid, apex + t * l, l, sphere_level(grid, d));
            t += cone_step * d;
        }
    }
    imageStore(voxels_light_visibility, at, vec4(open));
}

#endif
