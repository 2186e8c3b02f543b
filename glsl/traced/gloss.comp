// Glossy reflection at the visible surface by traced rays, drawn from its microfacet lobe by visible normals (Heitz 2018).
// Parts: light of later orders, which at the hits both lobes scatter, and from which a path goes on by the diffuse lobe;
// emitted light that is met; the environment where nothing is. Each is divided by what the lobe reflects of even light, so
// that it can be filtered. a: how many pixels wide that filter may be, by the lobe's width at the hit as the camera sees it.
#include "lib/frame.glsl"
#include "traced/lobes.glsl"
#include "traced/emitter_rays.glsl"
#include "traced/light.glsl"
#include "surface/start.glsl"
#include "lib/specular_albedo.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_roughness_metallic;
// What the gather found, at its own resolution. Images, because there are samplers enough.
layout(FORMAT_traced_filtered) readonly uniform image2D traced_filtered;
layout(FORMAT_traced_emitted) readonly uniform image2D traced_emitted;
layout(FORMAT_traced_sky) readonly uniform image2D traced_sky;
layout(FORMAT_traced_gloss) writeonly uniform image2D traced_gloss;
layout(FORMAT_traced_gloss_emitted) writeonly uniform image2D traced_gloss_emitted;
layout(FORMAT_traced_gloss_sky) writeonly uniform image2D traced_gloss_sky;

uniform int rays = 2;       //! [1, 64] per pixel
uniform int bounces = 1;    //! [1, 16] scattering orders after direct light
uniform float rough_from = 0.9; //! [0, 2] from this roughness on the lobe sees what the diffuse gather found; 2: never
uniform float filter_width = 0.5;  //! [0, 4] width of the filter, in widths of the lobe
uniform bool vary = false;  //! other directions in each frame, for accumulation

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    StartPoint start;
    vec3 later = vec3(0.0), emitted = vec3(0.0), sky = vec3(0.0);
    float width = 0.0;
    if (start_at(pixel, start)) {
        TracedSurface own;
        own.position = start.position;
        own.offset = dot(start.origin - start.position, start.face);
        own.face = start.face;
        own.shading = start.normal;
        own.base_colour = texelFetch(gbuffer_albedo, pixel, 0).rgb;
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        own.roughness = rm.x;
        own.metallic = rm.y;
        Lobes lobes = lobes_of(own, normalize(camera_position - start.position));
        vec3 even = specular_albedo(own.base_colour, own.metallic, own.roughness, lobes.nv);
        uint place = hash_combine(hash_combine(uint(pixel.x), uint(pixel.y)), vary ? uint(frame_index) + 1u : 0u);
        float met = 0.0;
        bool rough = lobes.glossy && own.roughness >= rough_from;
        if (rough) {
            ivec2 texel = pixel * imageSize(traced_filtered) / resolution;
            later = imageLoad(traced_filtered, texel).rgb * float(rays);
#ifdef HAS_traced_light_tables
            emitted = imageLoad(traced_emitted, texel).rgb * float(rays);
            sky = imageLoad(traced_sky, texel).rgb * float(rays);
#endif
            met = 1.0e3 * start.distance;
        }
        for (int i = 0; i < rays && lobes.glossy && !rough; ++i) {
            PixelSampler chances = pixel_sampler(place, uint(i));
            vec3 direction = draw_gloss(lobes, next_pair(chances));
            float nl = dot(lobes.n, direction);
            vec4 toward = gloss_toward(lobes, direction);
            bool going = nl > 0.0 && above(own, direction) && toward.a > 0.0;
            vec3 throughput = going ? toward.rgb * (nl / toward.a) / max(even, vec3(1.0e-4)) : vec3(0.0), origin = start.origin;
            for (int depth = 1; going; ++depth) {
                start_block(chances, uint(depth));
                TracedHit hit = trace_nearest(origin, direction, 3.0e38, sampler_key(chances, 1u));
                if (depth == 1) met += hit.draw == k_nothing ? 1.0e3 * start.distance : hit.t;
                going = hit.draw != k_nothing;
                if (!going) {
                    vec3 light = throughput * environment(direction);
                    if (depth == 1) sky += light;
                    else later += light;
                    continue;
                }
#ifdef HAS_traced_emitters
                TracedSurface s = surface_at(hit, direction, k_with_emission);
                // At later surfaces shadow rays ask for emitters.
                if (depth == 1) emitted += throughput * s.emission;
                going = depth <= bounces;
                if (!going) continue;
                if (any_emitters()) {
                    vec3 l, light = emitter_light(s, 0.0, chances, l);
                    later += throughput * light * k_pi * surface_lobes(s.shading, -direction, l, s.base_colour, s.metallic, s.roughness);
                }
#else
                TracedSurface s = surface_at(hit, direction, 0);
                going = depth <= bounces;
                if (!going) continue;
#endif
                later += throughput * scattered_light(s, -direction, false, sampler_key(chances, 2u));
                vec3 onward = frame_around(s.shading) * cosine_hemisphere(next_pair(chances));
                going = dot(s.shading, onward) > 0.0 && dot(s.face, onward) > 0.0;
#ifndef HAS_traced_light_tables
                going = going && depth < bounces;
#endif
                throughput *= k_pi * diffuse_lobe(s.shading, -direction, onward, s.base_colour, s.metallic, s.roughness);
                origin = start_off(s);
                direction = onward;
            }
        }
        later /= float(rays);
        emitted /= float(rays);
        sky /= float(rays);
        // Mirrors stay sharp.
        float pixels = float(resolution.y) / (2.0 * tan_half_vfov);
        width = filter_width * lobes.alpha * met / float(rays) / (start.distance + met / float(rays)) * pixels;
    }
    width = min(width, 1000.0);
    imageStore(traced_gloss, pixel, vec4(min(later, vec3(65504.0)), width));
    imageStore(traced_gloss_emitted, pixel, vec4(min(emitted, vec3(65504.0)), width));
    imageStore(traced_gloss_sky, pixel, vec4(min(sky, vec3(65504.0)), width));
}
