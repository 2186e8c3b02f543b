// Diffuse light by traced rays: at each texel's surface the mean of what N rays meet, with the density of the cosine (E/π).
// From each hit a path goes on for further bounces, and, where there are emitters or an environment, to find these. Parts: light of later orders; emitted light that the rays themselves meet, or shadow rays toward emitters;
// the environment likewise. a of the first: 1 − occlusion.
#include "lib/frame.glsl"
#include "traced/directions.glsl"
#include "traced/light.glsl"
#include "traced/light_tables.glsl"
#include "lib/sampling.glsl"
#include "lib/sampler.glsl"
#include "traced/start.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_traced_irradiance) writeonly uniform image2D traced_irradiance;
layout(FORMAT_traced_emitted) writeonly uniform image2D traced_emitted; // made where there are emitters or an environment
layout(FORMAT_traced_sky) writeonly uniform image2D traced_sky;         // likewise

uniform int rays = 16;           //! [1, 64] per texel
uniform int bounces = 1;         //! [1, 16] scattering orders after direct light
uniform float footprint = 0.0;   //! [0, 4] width over which a hit's textures are averaged, of the ray's share of the hemisphere
uniform int emitter_rays = 4;    //! [0, 64] shadow rays per texel toward emitters, drawn by power

float largest(vec3 v) {
    return max(v.r, max(v.g, v.b));
}

// A path's state where its ray leaves a surface.
struct Path {
    vec3 origin, from, direction; // `from`: the surface without the offset
    vec3 throughput;
    float density;
};

#ifdef HAS_traced_emitters
// Emitted light that reaches a surface, per π, by a shadow ray toward a drawn point; weighted against the diffuse lobe's
// rays, of which there are `own_rays` for each shadow ray. `l`: from where.
vec3 emitter_light(TracedSurface s, float own_rays, inout PixelSampler chances, out vec3 l) {
    float choice = next(chances);
    LightSample drawn = draw_emitter(s, choice, next_pair(chances));
    l = drawn.direction;
    float nl = dot(s.shading, l);
    bool reaches = drawn.density > 0.0 && nl > 0.0 && dot(s.face, l) > 0.0 && largest(drawn.radiance) > 0.0;
    if (!reaches || trace_any(start_off(s), drawn.to_end, drawn.reach, sampler_key(chances, 3u))) return vec3(0.0);
    return drawn.radiance * (nl * mis_weight(drawn.density, own_rays * nl / k_pi) / (k_pi * drawn.density));
}
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(traced_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    StartPoint start;
    vec3 later = vec3(0.0), emitted = vec3(0.0), sky = vec3(0.0);
    float met = 0.0;
    if (start_at(pixel_of(texel, size), start)) {
        Directions set = directions_at(texel, rays);
        mat3 frame = frame_around(start.normal);
        uint place = hash_combine(hash_combine(uint(texel.x), uint(texel.y)), vary ? uint(frame_index) + 1u : 0u);
        for (int i = 0; i < rays; ++i) {
            PixelSampler chances = pixel_sampler(place, uint(i));
            vec3 local = direction_of(set, i);
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
                float width = depth == 1 ? footprint * hit.t * sqrt(2.0 * k_pi / float(rays)) : 0.0;
#ifdef HAS_traced_light_tables
#ifdef HAS_traced_emitters
                TracedSurface s = surface_at(hit, path.direction, width * width, k_with_emission);
                if (largest(s.emission) > 0.0) {
                    float drawn = emitter_density(path.from, hit, s, path.direction);
                    float shadow_rays_each = depth > 1 ? 1.0 : float(emitter_rays) / float(rays);
                    vec3 light = path.throughput * s.emission * mis_weight(path.density, shadow_rays_each * drawn);
                    if (depth == 1) emitted += light;
                    else later += light;
                }
#else
                TracedSurface s = surface_at(hit, path.direction, width * width, 0);
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
                TracedSurface s = surface_at(hit, path.direction, width * width, 0);
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
#ifdef HAS_traced_emitters
        TracedSurface own;
        own.position = start.position;
        own.offset = dot(start.origin - start.position, start.face);
        own.face = start.face;
        own.shading = start.normal;
        for (int i = 0; any_emitters() && i < emitter_rays; ++i) {
            PixelSampler chances = pixel_sampler(hash_combine(place, 17u), uint(i));
            vec3 l;
            emitted += emitter_light(own, float(rays) / float(emitter_rays), chances, l) / float(emitter_rays);
        }
#endif
    }
    imageStore(traced_irradiance, texel, vec4(min(later, vec3(65504.0)), 1.0 - met / float(rays)));
#ifdef HAS_traced_light_tables
    imageStore(traced_emitted, texel, vec4(min(emitted, vec3(65504.0)), 1.0));
    imageStore(traced_sky, texel, vec4(min(sky, vec3(65504.0)), 1.0));
#endif
}
