#ifndef VOXEL_SPECULAR_CONE_GLSL
#define VOXEL_SPECULAR_CONE_GLSL
// Specular indirect light from a cone source that holds light: one cone about the mirror direction, 10° wide as published or
// as wide as the microfacet lobe (tan(θ/2) = α), times what the lobe reflects.
#include "lib/specular_albedo.glsl"
#include "voxel/cone_source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_out_indirect_specular) writeonly uniform image2D out_indirect_specular;

uniform bool aperture_from_roughness = false; //! the cone is as wide as the lobe; off: `aperture`, as published
uniform float aperture = 10.0;                //! [0.5, 90] (degrees) from side to side

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 radiance = vec3(0.0);
    if (depth > 0.0) {
        VoxelGrid grid = cone_grid();
        vec3 position = world_position(pixel, depth);
        vec3 v = normalize(camera_position - position);
        vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
        vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        vec3 albedo = specular_albedo(texelFetch(gbuffer_albedo, pixel, 0).rgb, rm.y, rm.x, max(dot(n, v), 0.0));
        vec3 mirrored = reflect(-v, n);
        // A normal map may mirror the view into the surface.
        float below = dot(mirrored, face);
        if (below < 0.02) mirrored = normalize(mirrored + (0.02 - below) * face);
        float diameter = 2.0 * (aperture_from_roughness ? brdf_alpha(rm.x) : tan(radians(0.5 * aperture)));
        radiance = albedo * light_along_cone(grid, cone_start(grid, position, face), mirrored, diameter).radiance;
    }
    imageStore(out_indirect_specular, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}

#endif
