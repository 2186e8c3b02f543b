// Glossy light at the pixel from a gather at a lower resolution, by the same upsampling as diffuse light: what was gathered
// is radiance over what the lobe reflects of even light, so it is multiplied by that at the pixel.
#include "lib/frame.glsl"
#include "lib/specular_albedo.glsl"
#include "surface/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D gathered_gloss;
layout(FORMAT_out_indirect_specular) writeonly uniform image2D out_indirect_specular;

uniform int interleave = 1; //! [1, 8] (texels) width of the box: as the gather's interleave

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 radiance = vec3(0.0);
    if (depth > 0.0) {
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        vec3 v = normalize(camera_position - world_position(pixel, depth));
        float cosine = dot(normalize(texelFetch(gbuffer_normal, pixel, 0).xyz), v);
        vec3 even = specular_albedo(texelFetch(gbuffer_albedo, pixel, 0).rgb, rm.y, rm.x, cosine);
        radiance = max(even, vec3(1.0e-4)) * upsampled(gathered_gloss, pixel, interleave).rgb;
    }
    imageStore(out_indirect_specular, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}
