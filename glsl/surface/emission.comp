// What is seen without any scattering: emissive surfaces, and the environment behind everything.
#include "lib/environment.glsl"
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_depth;
uniform sampler2D gbuffer_emission;  //! optional
layout(FORMAT_out_emission) writeonly uniform image2D out_emission;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    vec3 radiance = environment(normalize(pixel_ray(vec2(pixel))));
    // The neutral texture of a scene without emission has one texel only: clamp.
    ivec2 last = textureSize(gbuffer_emission, 0) - 1;
    if (texelFetch(gbuffer_depth, pixel, 0).r > 0.0) radiance = texelFetch(gbuffer_emission, min(pixel, last), 0).rgb;
    imageStore(out_emission, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}
