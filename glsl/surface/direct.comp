// Light of the punctual lights, scattered once toward the camera:
//   L_o(x, v) = Σ_lights f(v, l) · E_n · ⟨n·l⟩ · V(x, l),   E_n: irradiance at normal incidence (KHR_lights_punctual)
#define SCENE_LIGHTS
#include "lib/frame.glsl"
#include "lib/material_model.glsl"
#include "lib/scene.glsl"
#include "lib/shadow.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D gbuffer_depth;
uniform sampler2DArray shadow_depth;  //! optional
layout(std430) readonly buffer shadow_views { ShadowView views[]; };  //! optional
uniform sampler2DArray voxels_light_visibility;  //! optional unless visibility == cones, neutral 1
layout(FORMAT_out_direct) writeonly uniform image2D out_direct;

uniform bool shadows = true;         //! shadow maps are looked up; off: every light is seen from everywhere
uniform int visibility = 0;          //! {shadow_map, cones} who tells what the light does not reach: cones through voxels are soft
uniform bool receiver_plane = true;  //! compares each texel with the receiver's plane; off: with the point's depth
uniform float normal_offset = 0.125; //! [0, 16] (texels) how far a point is moved along its normal before it is looked up
uniform float depth_bias = 0.3;      //! [0, 16] (texels) how much nearer to the light a point is taken to be
uniform int filter_radius = 0;       //! [0, 4] (texels) percentage-closer filtering over (2r + 1)² texels

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) {
        imageStore(out_direct, pixel, vec4(0.0));
        return;
    }
    vec3 position = world_position(pixel, depth);
    vec3 v = normalize(camera_position - position);
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    vec3 base_colour = texelFetch(gbuffer_albedo, pixel, 0).rgb;
    vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;

    vec3 radiance = vec3(0.0);
    for (int i = 0; i < light_count; ++i) {
        Light light = lights[i];
        vec3 l;
        vec3 irradiance = light_irradiance(light, position, l);
        float cosine = dot(n, l);
        // Both sides reflect, but light does not pass: it must come from the side that the viewer is on.
        if (cosine <= 0.0 || dot(face, l) <= 0.0 || max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0) continue;
        if (shadows && visibility == visibility_cones) {
            irradiance *= texelFetch(voxels_light_visibility, ivec3(pixel, i), 0).r;
        } else if (shadows && light.shadow_base >= 0) {
            int layer = shadow_layer(light, position);
            irradiance *= shadow_visibility(shadow_depth, views[layer], layer, position, face, normal_offset, depth_bias, filter_radius, receiver_plane);
        }
        radiance += surface_lobes(n, v, l, base_colour, rm.y, rm.x) * irradiance * cosine;
    }
    imageStore(out_direct, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}
