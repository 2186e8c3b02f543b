#ifndef SURFACE_UPSAMPLE_GLSL
#define SURFACE_UPSAMPLE_GLSL
// Bilateral upsampling: a value at the pixel from texels of a lower resolution, or from neighbours that took different
// samples: a box of `interleave` texels (which so holds each set of samples once), times how well a texel's surface agrees
// in normal and in distance to the pixel's plane.
#include "lib/frame.glsl"
#include "surface/gbuffer_depth.glsl"

uniform float normal_power = 16.0;     //! [0, 256] upsampling: weights fall with ⟨n·n'⟩ to this power
uniform float plane_distance = 0.01;   //! [1e-4, 1] upsampling: plane distance with weight 1/e, share of the view distance

vec4 upsampled(sampler2D coarse, ivec2 pixel, int interleave) {
    ivec2 size = textureSize(coarse, 0);
    if (size == resolution && interleave == 1) return texelFetch(coarse, pixel, 0);
    vec3 position = world_position(pixel, texelFetch(gbuffer_depth, pixel, 0).r);
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec2 at = (vec2(pixel) + 0.5) * vec2(size) / vec2(resolution) - 0.5; // in texels, from the first one's middle
    float half_width = 0.5 * float(interleave);
    ivec2 low = ivec2(floor(at - half_width + 0.5)), high = ivec2(floor(at + half_width + 0.5));
    float tolerance = plane_distance * length(position - camera_position);
    vec4 sum = vec4(0.0), nearest = vec4(0.0);
    float total = 0.0, best = -1.0;
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            // The part of the texel that lies in the box. (For a width of one: bilinear weights.)
            vec2 inside = clamp(half_width + 0.5 - abs(vec2(x, y) - at), vec2(0.0), vec2(1.0));
            ivec2 texel = clamp(ivec2(x, y), ivec2(0), size - 1);
            ivec2 there = min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
            float depth = texelFetch(gbuffer_depth, there, 0).r;
            if (depth <= 0.0) continue;
            float off_plane = dot(n, world_position(there, depth) - position) / tolerance;
            float agree = pow(max(dot(n, texelFetch(gbuffer_normal, there, 0).xyz), 0.0), normal_power) * exp(-off_plane * off_plane);
            vec4 value = texelFetch(coarse, texel, 0);
            float weight = inside.x * inside.y * agree;
            sum += weight * value;
            total += weight;
            if (agree > best) best = agree, nearest = value;
        }
    }
    return total > 1.0e-4 ? sum / total : nearest;
}
#endif
