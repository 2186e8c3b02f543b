#ifndef RSM_GATHER_POINT_GLSL
#define RSM_GATHER_POINT_GLSL
// Indirect light of one point from reflective shadow maps (Dachsbacher & Stamminger 2005, sections 4.2 and 5):
//   E(x, n) = Σ_p Φ_p ⟨n_p·(x − x_p)⟩⟨n·(x_p − x)⟩ / (π·|x − x_p|⁴), without visibility,
// over samples of each view's map. As published they lie around the point's own place in the map, at
//   r_max·(ξ₁ sin 2πξ₂, ξ₁ cos 2πξ₂), weighted by ξ₁²;
// their density falls as 1/ξ₁, so the weight that leaves the sum over all texels as it is, is ξ₁.
#include "lib/frame.glsl"
#include "lib/interleave.glsl"
#include "surface/map_texel.glsl"

uniform int samples = 400;        //! [1, 4096] per view: texels that are asked; pattern every_texel asks all
uniform int pattern = 0;          //! {disc, whole_map, every_texel} around the point's place in the map (published), evenly over it, or without sampling
uniform float radius = 0.3;       //! [0.01, 2] pattern disc: r_max as a share of the map's width
uniform int weight = 0;           //! {squared, linear} pattern disc: ξ² as published, or ξ, which is unbiased
uniform bool keep_inside = false; //! pattern disc: a point beside the map or behind the light takes the nearest place in it; off: no light
uniform float spread = 0.0;       //! [0, 16] a sample is softened like a disc of so many times the area that it stands for; 0: published
uniform int interleave = 1;       //! [1, 8] (texels) neighbours in blocks of n × n take different samples; 1: all take the same

// The sample's place in the map as shares of its width, and its weight: Σ weight over a pattern is the number of texels
// that it stands for.
vec3 rsm_sample(int i, vec2 centre, float part, float texels) {
    // R2 (Roberts 2018), shifted from texel to texel of a block; in the disc, radii in a row and turns a golden angle apart.
    vec2 xi = fract(vec2(0.7548776662, 0.5698402910) * (float(i) + 0.5) + part * vec2(0.6180339887, 0.3819660113));
    if (pattern == pattern_whole_map) return vec3(xi, texels / float(samples));
    xi = vec2((float(i) + part) / float(samples), fract(0.6180339887 * (float(i) + 16.0 * part)));
    vec2 offset = radius * xi.x * vec2(sin(6.28318530718 * xi.y), cos(6.28318530718 * xi.y));
    // Both weights are scaled so that they sum up to the disc's area.
    float share = weight == weight_squared ? 3.0 * xi.x * xi.x : 2.0 * xi.x;
    return vec3(centre + offset, 3.14159265359 * radius * radius * texels * share / float(samples));
}

// The point's own place in a map. False: it has none.
bool place_in_map(ShadowView view, vec3 x, out vec2 centre) {
    vec4 clip = view.view_projection * vec4(x, 1.0);
    centre = clip.xy / max(clip.w, 0.01 * scene_diagonal) * 0.5 + 0.5;
    if (keep_inside) {
        centre = clamp(centre, vec2(0.0), vec2(1.0));
        return true;
    }
    return clip.w > 0.0;
}

// E/π. `part`: interleaved_part of the texel that asks.
vec3 rsm_gather(vec3 x, vec3 n, float part) {
    ivec3 size = textureSize(rsm_depth, 0);
    vec3 sum = vec3(0.0);
    for (int v = 0; v < shadow_view_count; ++v) {
        vec2 centre = vec2(0.5);
        // Software drivers cut long loops off: 256² texels in all are as much as an invocation gets through.
        if (pattern == pattern_every_texel) {
            for (int i = 0; i < size.x * size.y; ++i)
                sum += texel_light(map_texel(ivec3(i % size.x, i / size.x, v)), x, n, spread);
            continue;
        }
        if (pattern == pattern_disc && !place_in_map(views[v], x, centre)) continue;
        for (int i = 0; i < samples; ++i) {
            vec3 at = rsm_sample(i, centre, part, float(size.x * size.y));
            if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThanEqual(at.xy, vec2(1.0)))) continue;
            sum += at.z * texel_light(map_texel(ivec3(at.xy * vec2(size.xy), v)), x, n, spread * at.z);
        }
    }
    return sum;
}
#endif
