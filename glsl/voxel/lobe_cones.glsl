#ifndef VOXEL_LOBE_CONES_GLSL
#define VOXEL_LOBE_CONES_GLSL
// Specular indirect light from a cone source that holds light, by cones that are drawn from the microfacet lobe by visible
// normals (Heitz 2018): a wide lobe is more than one cone about the mirror direction. A lobe that is nearly all of the
// hemisphere sees what the diffuse gather found. What is found is divided by what the lobe reflects of even light, so that it
// can be filtered (surface/atrous.comp, guided); a: how many pixels wide that filter may be.
#include "lib/frame.glsl"
#include "lib/lobes.glsl"
#include "lib/sampler.glsl"
#include "lib/specular_albedo.glsl"
#include "surface/upsample.glsl"
#include "voxel/cone_source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gathered_irradiance; // E/π
uniform sampler2D gathered_emitted;    //! optional // E/π that emitters bring, which were asked for apart
layout(FORMAT_gloss_gathered) writeonly uniform image2D gloss_gathered;

uniform int lobe_cones = 2;        //! [1, 64] cones of a pixel
uniform float cone_share = 1.0;    //! [0, 4] width of a cone, in parts of the lobe that one of `lobe_cones` has
uniform float rough_from = 0.9;    //! [0, 2] from this roughness on the lobe sees what the diffuse gather found; 2: never
uniform float filter_width = 0.5;  //! [0, 4] width of the filter, in widths of the lobe
uniform bool vary = false;         //! other directions in each frame, for accumulation

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 light = vec3(0.0);
    float width = 0.0;
    if (depth > 0.0) {
        vec3 position = world_position(pixel, depth), to_viewer = camera_position - position;
        vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
        vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        vec3 base_colour = texelFetch(gbuffer_albedo, pixel, 0).rgb;
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        float distance = length(to_viewer), met = 0.0;
        Lobes lobes = lobes_at(n, to_viewer / distance, base_colour, rm.y, rm.x);
        vec3 even = max(specular_albedo(base_colour, rm.y, rm.x, lobes.nv), vec3(1.0e-4));
        if (lobes.glossy && rm.x >= rough_from) {
            light = upsampled(gathered_irradiance, pixel, 1).rgb;
#ifdef HAS_gathered_emitted
            light += upsampled(gathered_emitted, pixel, 1).rgb;
#endif
        } else if (lobes.glossy) {
            VoxelGrid grid = cone_grid();
            ConeStart start = cone_start(grid, position, face);
            float diameter = cone_share * 2.0 * lobes.alpha / sqrt(float(lobe_cones));
            uint place = hash_combine(hash_combine(uint(pixel.x), uint(pixel.y)), vary ? uint(frame_index) + 1u : 0u);
            for (int i = 0; i < lobe_cones; ++i) {
                PixelSampler chances = pixel_sampler(place, uint(i));
                vec3 direction = draw_gloss(lobes, next_pair(chances));
                float nl = dot(n, direction);
                vec4 toward = gloss_toward(lobes, direction);
                if (!(nl > 0.0 && dot(face, direction) > 0.0 && toward.a > 0.0)) continue;
                ConeLight found = light_along_cone(grid, start, direction, diameter);
                light += toward.rgb * (nl / toward.a) / even * found.radiance / float(lobe_cones);
                met += (found.away < 0.0 ? 10.0 * distance : found.away) / float(lobe_cones);
            }
            // Mirrors stay sharp.
            float pixels = float(resolution.y) / (2.0 * tan_half_vfov);
            width = min(filter_width * lobes.alpha * met / (distance + met) * pixels, 1000.0);
        }
    }
    imageStore(gloss_gathered, pixel, vec4(min(light, vec3(65504.0)), width));
}

#endif
