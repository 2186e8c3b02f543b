// Diffuse light by traced rays: at each texel's surface the mean of what N rays meet, with the density of the cosine (E/π).
// From each hit a path goes on for further bounces and, where there are emitters or an environment, to find these. Parts:
// light of later orders; what the rays themselves meet of emitters (traced/emitted.comp adds the rest) and of the
// environment. a of the first: 1 − occlusion.
#include "lib/frame.glsl"
#include "voxel/directions.glsl"
#include "traced/emitter_rays.glsl"
#include "traced/light.glsl"
#include "surface/start.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_traced_irradiance) writeonly uniform image2D traced_irradiance;
layout(FORMAT_traced_emitted) writeonly uniform image2D traced_emitted; // made where there are emitters or an environment
layout(FORMAT_traced_sky) writeonly uniform image2D traced_sky;         // likewise

uniform int rays = 12;   //! [1, 64] per texel
uniform int bounces = 1; //! [1, 16] scattering orders after direct light

// A path's state where its ray leaves a surface.
struct Path {
    vec3 origin, from, direction; // `from`: the surface without the offset
    vec3 throughput;
    float density;
};

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(traced_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    StartPoint start;
    vec3 later = vec3(0.0), emitted = vec3(0.0), sky = vec3(0.0);
    float met = 0.0;
    if (start_at(pixel_of(texel, size), start)) {
        SamplePattern which = pattern_at(texel);
        mat3 frame = frame_around(start.normal);
        uint place = hash_combine(hash_combine(uint(texel.x), uint(texel.y)), vary ? uint(frame_index) + 1u : 0u);
        for (int i = 0; i < rays; ++i) {
            PixelSampler chances = pixel_sampler(place, uint(i));
            vec3 local = direction_of(which, i, rays);
            Path path = Path(start.origin, start.position, frame * local, vec3(1.0), local.z / k_pi);
            bool going = dot(path.direction, start.face) > 0.0;
            for (int depth = 1; going; ++depth) {
                start_block(chances, uint(depth));
                uint coverage = sampler_key(chances, 1u);
                TracedHit hit = trace_nearest(path.origin, path.direction, 3.0e38, coverage);
                if (depth == 1 && hit.draw != k_nothing) met += 1.0;
                going = hit.draw != k_nothing && depth <= bounces;
#ifdef HAS_traced_light_tables
                if (hit.draw == k_nothing) {
                    vec3 light = path.throughput * environment(path.direction);
                    if (depth == 1) sky += light;
                    else later += light;
                }
                going = hit.draw != k_nothing;
#endif
                if (!going) continue;
#ifdef HAS_traced_light_tables
#ifdef HAS_traced_emitters
                TracedSurface s = surface_at(hit, path.direction, k_with_emission);
                if (largest(s.emission) > 0.0) {
                    float drawn = emitter_density(path.from, hit, s, path.direction);
                    vec3 light = path.throughput * s.emission * mis_weight(path.density, (depth > 1 ? 1.0 : k_shadow_rays_each) * drawn);
                    if (depth == 1) emitted += light;
                    else later += light;
                }
#else
                TracedSurface s = surface_at(hit, path.direction, 0);
#endif
                going = depth <= bounces;
                if (!going) continue;
#ifdef HAS_traced_emitters
                if (any_emitters()) {
                    vec3 l, light = emitter_light(s, 1.0, chances, l);
                    later += path.throughput * light * k_pi * diffuse_lobe(s.shading, -path.direction, l, s.base_colour, s.metallic, s.roughness);
                }
#endif
#else
                TracedSurface s = surface_at(hit, path.direction, 0);
                going = depth < bounces;
#endif
                later += path.throughput * scattered_light(s, -path.direction, true, sampler_key(chances, 2u));
                // On, by the diffuse lobe.
                vec3 onward = frame_around(s.shading) * cosine_hemisphere(next_pair(chances));
                float nl = dot(s.shading, onward);
                going = going && nl > 0.0 && dot(s.face, onward) > 0.0;
                path.throughput *= k_pi * diffuse_lobe(s.shading, -path.direction, onward, s.base_colour, s.metallic, s.roughness);
                path.density = nl / k_pi;
                path.origin = start_off(s);
                path.from = s.position;
                path.direction = onward;
            }
        }
        later /= float(rays);
        emitted /= float(rays);
        sky /= float(rays);
    }
    imageStore(traced_irradiance, texel, vec4(min(later, vec3(65504.0)), 1.0 - met / float(rays)));
#ifdef HAS_traced_light_tables
    imageStore(traced_emitted, texel, vec4(min(emitted, vec3(65504.0)), 1.0));
    imageStore(traced_sky, texel, vec4(min(sky, vec3(65504.0)), 1.0));
#endif
}
