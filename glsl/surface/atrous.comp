// One level of an edge-avoiding à-trous filter (Dammertz et al. 2010) over what a gather made at its own resolution, before
// it is multiplied by albedo: texels `step` apart, weighted by how well their surfaces agree in normal and in distance to
// the plane. Levels of steps 1, 2, … follow one another.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform sampler2D filter_input;
uniform sampler2D filter_frames; //! optional, neutral 1 // that the input holds (surface/temporal.comp)
layout(FORMAT_filter_output) writeonly uniform image2D filter_output;

uniform int step = 1;                //! [1, 64] (texels) between the texels that are averaged
uniform int radius = 1;              //! [0, 2] steps to either side: 3 × 3 or 5 × 5 texels; 0: nothing is filtered
uniform float normal_power = 16.0;   //! [0, 256] weights fall with ⟨n·n'⟩ to this power
uniform bool guided = false;         //! static the input's a is each texel's width of filter, in texels
uniform float narrow_from = 4.0;     //! [1, 65536] frames from which on neighbours count less: the filter ends as the mean converges
uniform float plane_distance = 0.01; //! [1e-4, 1] plane distance with weight 1/e, share of the view distance

ivec2 pixel_of(ivec2 texel, ivec2 size) {
    return min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(filter_output);
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = pixel_of(texel, size);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec4 own = texelFetch(filter_input, texel, 0), sum = vec4(0.0);
    float total = 0.0;
    vec3 position = world_position(pixel, max(depth, 1.0e-30)), n = texelFetch(gbuffer_normal, pixel, 0).xyz;
    float tolerance = plane_distance * length(position - camera_position);
    float share = min(narrow_from / max(texelFetch(filter_frames, min(texel, textureSize(filter_frames, 0) - 1), 0).r, 1.0), 1.0);
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            ivec2 at = texel + step * ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            ivec2 there = pixel_of(at, size);
            float its = texelFetch(gbuffer_depth, there, 0).r;
            if (its <= 0.0) continue;
            // Binomial weights: 1 2 1 or 1 4 6 4 1.
            vec2 tap = radius == 1 ? vec2(2 - abs(ivec2(x, y))) : vec2(6, 6) - vec2(abs(ivec2(x, y))) * 2.0 - vec2(max(abs(ivec2(x, y)) - 1, 0));
            float off_plane = dot(n, world_position(there, its) - position) / tolerance;
            float weight = tap.x * tap.y * pow(max(dot(n, texelFetch(gbuffer_normal, there, 0).xyz), 0.0), normal_power) * exp(-off_plane * off_plane);
            if (x != 0 || y != 0) weight *= share;
#if guided
            float away2 = float(step * step) * dot(vec2(x, y), vec2(x, y));
            weight *= exp(-away2 / max(own.a * own.a, 1.0e-6));
#endif
            sum += weight * texelFetch(filter_input, at, 0);
            total += weight;
        }
    }
    imageStore(filter_output, texel, radius > 0 && depth > 0.0 && total > 0.0 ? sum / total : own);
}
