// From the gather's resolution to the picture's (Dachsbacher & Stamminger 2005, section 5): a pixel is interpolated from the
// four texels around it as far as their normals and planes agree with its own, and gathers by itself where fewer than three
// do. a: 1 where it gathered by itself.
#include "rsm/gather_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform sampler2D rsm_irradiance;
layout(FORMAT_rsm_refined) writeonly uniform image2D rsm_refined;

uniform float least_cosine = 0.9;    //! [0, 1] normals that agree
uniform float plane_distance = 0.01; //! [1e-4, 1] planes that agree, as a share of the view distance

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) {
        imageStore(rsm_refined, pixel, vec4(0.0));
        return;
    }
    vec3 x = world_position(pixel, depth), n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    float tolerance = plane_distance * length(x - camera_position);
    ivec2 size = textureSize(rsm_irradiance, 0);
    vec2 at = (vec2(pixel) + 0.5) * vec2(size) / vec2(resolution) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 share = at - vec2(low);
    vec4 sum = vec4(0.0);
    int agreeing = 0;
    for (int k = 0; k < 4; ++k) {
        ivec2 corner = ivec2(k & 1, k >> 1);
        ivec2 texel = clamp(low + corner, ivec2(0), size - 1);
        ivec2 there = min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
        float its = texelFetch(gbuffer_depth, there, 0).r;
        if (its <= 0.0 || dot(n, texelFetch(gbuffer_normal, there, 0).xyz) < least_cosine) continue;
        if (abs(dot(n, world_position(there, its) - x)) > tolerance) continue;
        vec2 bilinear = mix(1.0 - share, share, vec2(corner));
        sum += bilinear.x * bilinear.y * vec4(texelFetch(rsm_irradiance, texel, 0).rgb, 1.0);
        ++agreeing;
    }
    bool own = agreeing < 3 || sum.a <= 0.0;
    vec3 light = own ? rsm_gather(x, n, interleaved_part(pixel, interleave)) : sum.rgb / sum.a;
    imageStore(rsm_refined, pixel, vec4(min(light, vec3(65504.0)), own ? 1.0 : 0.0));
}
