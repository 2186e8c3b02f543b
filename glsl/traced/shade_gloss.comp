// What gloss.comp found, filtered, times what the lobe reflects of even light.
#include "lib/frame.glsl"
#include "lib/specular_albedo.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D traced_gloss;

uniform bool adds = false; //! static to what the diffuse lobe reflects

#if adds
layout(FORMAT_out_indirect_specular) uniform image2D out_indirect_specular; //! ordered: each has its own pixel
#else
layout(FORMAT_out_indirect_specular) writeonly uniform image2D out_indirect_specular;
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 radiance = vec3(0.0);
    if (depth > 0.0) {
        vec3 v = normalize(camera_position - world_position(pixel, depth)), n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        vec3 even = specular_albedo(texelFetch(gbuffer_albedo, pixel, 0).rgb, rm.y, rm.x, dot(n, v));
        radiance = max(even, vec3(1.0e-4)) * texelFetch(traced_gloss, pixel, 0).rgb;
    }
#if adds
    radiance += imageLoad(out_indirect_specular, pixel).rgb;
#endif
    imageStore(out_indirect_specular, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}
