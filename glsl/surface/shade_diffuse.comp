// Diffuse indirect light at the pixel: ρ · (E/π), where ρ is the diffuse lobe's albedo toward the viewer. Where the gather ran at a lower resolution, or neighbouring texels took
// different cones, the texels around are blended: a box of `interleave` texels (which so holds each set of cones once),
// times how well a texel's surface agrees in normal and in distance to the pixel's plane.
#include "lib/frame.glsl"
#include "lib/material_model.glsl"
#include "surface/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D gathered_irradiance; // E/π, W/(sr·m²)
layout(FORMAT_out_indirect_diffuse) writeonly uniform image2D out_indirect_diffuse;

uniform int interleave = 1;            //! [1, 8] (texels) width of the box: as the gather's interleave

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 radiance = vec3(0.0);
    if (depth > 0.0) {
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        vec3 v = normalize(camera_position - world_position(pixel, depth));
        float cosine = dot(normalize(texelFetch(gbuffer_normal, pixel, 0).xyz), v);
        radiance = diffuse_albedo(texelFetch(gbuffer_albedo, pixel, 0).rgb, rm.y, rm.x, cosine) * upsampled(gathered_irradiance, pixel, interleave).rgb;
    }
    imageStore(out_indirect_diffuse, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}
