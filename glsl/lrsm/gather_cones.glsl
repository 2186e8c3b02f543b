#ifndef LRSM_GATHER_CONES_GLSL
#define LRSM_GATHER_CONES_GLSL
// The cones of one texel of the final gather: where they start, which they are, what each brings. The gather and the
// view of its cones share this, so that what is shown is what is done.
#include "lrsm/cone.glsl"
#include "voxel/cone_set.glsl"

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;

uniform int cone_set = 0;       //! {six, six_tilted, spiral} six as published
uniform int spiral_cones = 32;  //! [4, 128] cones of the set spiral
uniform int interleave = 1;     //! [1, 8] (texels) neighbours in blocks of n × n take different cones; 1: all take the same
uniform float aperture = 60.0;  //! [1, 90] (degrees) of each cone, from side to side

struct GatherPoint {
    ConeStart start;
    mat3 frame; // of the surface's normal
    float part; // see interleaved_part
};

// At less than full resolution each texel takes the pixel at its middle.
ivec2 gather_pixel(ivec2 texel, ivec2 size) {
    return min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
}

// False for the background.
bool gather_point(VoxelGrid grid, ivec2 texel, ivec2 pixel, out GatherPoint point) {
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) return false;
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    point.start = cone_start(grid, world_position(pixel, depth), face);
    point.frame = frame_around(n);
    point.part = interleaved_part(texel, interleave);
    return true;
}

int gather_cone_count() {
    return cone_count(cone_set, spiral_cones);
}

// Radiance along cone i, and in a its occlusion. `cone`: its direction and weight.
vec4 gather_cone(VoxelGrid grid, GatherPoint point, int i, float diameter, out vec4 cone) {
    cone = cone_of(cone_set, spiral_cones, i, point.part);
    cone.xyz = point.frame * cone.xyz;
    return trace_lit_cone(grid, point.start, cone.xyz, diameter);
}

#endif
