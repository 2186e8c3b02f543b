// Final gather of diffuse indirect light (DVS, section VIII.A): a set of cones over the hemisphere of each pixel's surface.
// Writes the mean radiance from there, weighted by the cosine (E/π): times the albedo it is what the surface sends on.
// a = 1 − δ, the ambient occlusion of the same cones (section VIII.B). At less than full resolution each texel takes the pixel at its middle.
uniform int hit = 1; //! static {voxel, plane, triangle, near_triangle} exact hits: the voxel, its plane, triangles, these near by
uniform float near_share = 0.05; //! [0.001, 1] (scene diagonals) hit near_triangle: how far triangles count, and voxels beyond
#define CHOOSES_HITS
uniform int hit_lookup = 0;     //! static {voxels, map} light at the hit: the voxel's or the triangle's own; or from the reflective shadow maps
#if hit >= hit_triangle
#if hit_lookup == hit_lookup_map
#include "dvs/walked_cone.glsl"
#else
#include "dvs/triangle_cone.glsl"
#endif
#else
#include "dvs/walked_cone.glsl"
#endif
#include "voxel/cone_set.glsl"
#include "surface/gbuffer_surface.glsl"
#include "surface/sample_pattern.glsl"
#include "lib/environment.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform bool sky_light = false; //! static what nothing blocks brings light of the environment (dvs.sky); off as published

layout(FORMAT_dvs_irradiance) writeonly uniform image2D dvs_irradiance;
#if sky_light
layout(FORMAT_dvs_sky) writeonly uniform image2D dvs_sky; // the environment's E/π
#endif

uniform int cone_set = 0;       //! {six, six_tilted, spiral} six as published
uniform int spiral_cones = 32;  //! [4, 128] auto(cones) cones of the set spiral
uniform bool dithered_start = false; //! shifts the first step differently in blocks of 4 × 4: noise instead of bands
uniform float aperture = 60.0;  //! [1, 90] (degrees) of each cone, from side to side

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(dvs_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) {
        imageStore(dvs_irradiance, texel, vec4(0.0));
#if sky_light
        imageStore(dvs_sky, texel, vec4(0.0));
#endif
        return;
    }
    VoxelGrid grid = cone_grid();
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    ConeStart start = cone_start(grid, world_position(pixel, depth), face);
#if hit >= hit_triangle
    StartPoint exact;
    start_at(pixel, exact);
#endif
    mat3 frame = frame_around(n);
    float diameter = 2.0 * tan(radians(0.5 * aperture));
    SamplePattern which = pattern_at(texel);
    float start_share = dithered_start ? interleaved_part(texel, 4) : 0.0;
    vec4 sum = vec4(0.0);
    vec3 open = vec3(0.0);
    for (int i = 0; i < cone_count(cone_set, spiral_cones); ++i) {
        vec4 cone = cone_of(cone_set, spiral_cones, i, which.part, which.turn);
        vec3 direction = frame * cone.xyz;
#if hit >= hit_triangle
        uint seed = hash_combine(hash_combine(uint(texel.x) | (uint(texel.y) << 16), vary ? uint(frame_index) : 0u), uint(i)) | 1u;
#if hit_lookup == hit_lookup_map
        Traced traced = trace_cone_to_triangle(grid, start, exact, direction, diameter, seed);
#else
        Traced traced = trace_triangle_cone(grid, start, exact, direction, diameter, seed);
#endif
#else
        Traced traced = hit_lookup == hit_lookup_map ? trace_walked_cone(grid, start, direction, diameter)
                                        : trace_cone(grid, start.apex, direction, diameter, start_share);
#endif
        sum += cone.w * vec4(traced.colour, traced.ambient_occlusion);
        if (sky_light && dot(direction, face) > 0.0) open += cone.w * (1.0 - traced.occlusion) * environment(direction);
    }
    imageStore(dvs_irradiance, texel, vec4(min(sum.rgb, vec3(65504.0)), 1.0 - sum.a));
#if sky_light
    imageStore(dvs_sky, texel, vec4(min(open, vec3(65504.0)), 1.0));
#endif
}
