// E/π from reflective shadow maps at the gather's own resolution: each texel at the pixel in its middle.
#include "rsm/gather_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_rsm_irradiance) writeonly uniform image2D rsm_irradiance;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(rsm_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 light = vec3(0.0);
    if (depth > 0.0)
        light = rsm_gather(world_position(pixel, depth), normalize(texelFetch(gbuffer_normal, pixel, 0).xyz), interleaved_part(texel, interleave));
    imageStore(rsm_irradiance, texel, vec4(min(light, vec3(65504.0)), 1.0));
}
