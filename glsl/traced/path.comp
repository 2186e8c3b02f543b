// Path tracing: one more sample of each pixel, added to the means of all. Unidirectional, next-event estimation and lobe
// sampling joined by multiple importance sampling (Veach 1997). At the visible surface both lobes are followed by a path of
// their own, which keeps the parts apart. It takes the samples that the reference takes (passes/reference/integrator.cpp).
#include "lib/frame.glsl"
#include "lib/camera.glsl"
#include "traced/lobes.glsl"
#include "traced/trace.glsl"
#include "traced/light_tables.glsl"
#include "traced/soft_lights.glsl"
#include "lib/sampler.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Means so far; a = samples, but in out_emission: what they were taken of.
layout(FORMAT_out_direct) uniform image2D out_direct; //! ordered: each has its own pixel
layout(FORMAT_out_emitted) uniform image2D out_emitted; //! ordered: each has its own pixel
layout(FORMAT_out_environment) uniform image2D out_environment; //! ordered: each has its own pixel
layout(FORMAT_out_indirect_diffuse) uniform image2D out_indirect_diffuse; //! ordered: each has its own pixel
layout(FORMAT_out_indirect_specular) uniform image2D out_indirect_specular; //! ordered: each has its own pixel
layout(FORMAT_out_emission) uniform image2D out_emission; //! ordered: each has its own pixel

uniform int samples = 1;        //! [1, 256] per pixel and frame
uniform int bounces = -1;       //! [-1, 64] scattering orders after the first; -1: all
uniform int roulette_depth = 3; //! [0, 64] bounces after which paths may end by chance, without bias
uniform bool glossy_secondary = true; //! off: surfaces behind the visible one have their diffuse lobe alone
uniform int seed = 0;           //! [0, 1000000] pictures of different seeds are independent

// Which part a light's first scattering belongs to.
const int k_punctual = 0, k_emitted = 1, k_sky = 2;
// Rays that may be traced at one point of a sampler's sequence; the lights' come last.
const uint k_camera_ray = 0u, k_diffuse_ray = 1u, k_gloss_ray = 2u, k_emitter_ray = 3u, k_sky_ray = 4u, k_light_ray = 5u;
// Up to so many lights are all asked, beyond that one of them is drawn.
const int k_all_lights_at_camera = 16, k_all_lights = 4;
const float k_roulette_throughput = 0.1;
const int k_long_path = 64; // from here on every bounce may be the last

const int k_before = 0, k_diffuse_path = 1, k_gloss_path = 2;

float far_of(TracedHit hit) {
    return hit.draw == k_nothing ? 3.0e38 : hit.t;
}

bool any_soft_light() {
    for (int i = 0; i < light_count; ++i)
        if (light_is_soft(lights[i])) return true;
    return false;
}

bool anything_to_meet() {
    return max(environment_radiance.r, max(environment_radiance.g, environment_radiance.b)) > 0.0 || any_emitters() || any_soft_light();
}

// Next-event estimation: for each light that reaches the surface, or one of many, a shadow ray. What it adds is by kind
// where `first`, and otherwise in sums[0].
void sample_lights(TracedSurface s, Lobes lobes, bool first, vec3 throughput, inout PixelSampler chances, inout vec3 sums[3]) {
    bool soft = any_soft_light();
    int asked = light_count <= (first ? k_all_lights_at_camera : k_all_lights) ? light_count : 1, chosen = -1;
    float probability = 1.0;
    if (asked < light_count) {
        float sum = 0.0, before = 0.0, target = next(chances);
        for (int i = 0; i < light_count; ++i) sum += light_importance(lights[i], s.position);
        for (int i = 0; i < light_count && chosen < 0; ++i) {
            float importance = light_importance(lights[i], s.position);
            before += importance;
            if (before <= target * sum || importance <= 0.0) continue;
            chosen = i;
            probability = importance / sum;
        }
    }
    int emitter = any_emitters() ? asked : -1, sky = sky_is_drawn() ? asked + (emitter >= 0 ? 1 : 0) : -1;
    int count = asked + (emitter >= 0 ? 1 : 0) + (sky >= 0 ? 1 : 0);
    for (int i = 0; i < count; ++i) {
        LightSample drawn;
        uint coverage;
        int kind = k_punctual;
        if (i == emitter) {
            float choice = next(chances);
            drawn = draw_emitter(s, choice, next_pair(chances));
            coverage = sampler_key(chances, k_emitter_ray);
            kind = k_emitted;
        } else if (i == sky) {
            float choice = next(chances);
            drawn = draw_sky(choice, next_pair(chances));
            coverage = sampler_key(chances, k_sky_ray);
            kind = k_sky;
        } else {
            int light = chosen >= 0 ? chosen : i;
            vec2 u = vec2(0.0);
            if (soft) u = next_pair(chances);
            if (asked < light_count && chosen < 0) continue; // none reaches the surface
            drawn = draw_light(lights[light], s, u);
            drawn.density *= probability;
            coverage = sampler_key(chances, k_light_ray + uint(light));
        }
        float nl = dot(lobes.n, drawn.direction);
        bool reaches = drawn.density != 0.0 && nl > 0.0 && above(s, drawn.direction) && max(drawn.radiance.r, max(drawn.radiance.g, drawn.radiance.b)) > 0.0;
        if (!reaches || trace_any(start_off(s), drawn.to_end, drawn.reach, coverage)) continue;
        // A hard light's direction has no density: nothing else finds it.
        bool hard = drawn.density < 0.0;
        vec3 irradiance = nl * drawn.radiance / abs(drawn.density);
        if (first) {
            vec4 gloss = gloss_toward(lobes, drawn.direction);
            vec3 diffuse = diffuse_lobe(lobes.n, lobes.v, drawn.direction, s.base_colour, s.metallic, s.roughness);
            sums[kind] += irradiance * (diffuse * (hard ? 1.0 : mis_weight(drawn.density, nl / k_pi)) +
                                        gloss.rgb * (hard ? 1.0 : mis_weight(drawn.density, gloss.a)));
        } else {
            vec4 f = both_toward(s, lobes, drawn.direction);
            sums[0] += throughput * irradiance * f.rgb * (hard ? 1.0 : mis_weight(drawn.density, f.a));
        }
    }
}

// What a ray drawn from a lobe with `density` meets by itself, weighted against next-event estimation: by kind.
void meet_lights(vec3 from, vec3 direction, TracedHit hit, TracedSurface met, float density, int max_lights, vec3 throughput, inout vec3 sums[3]) {
    float all = 0.0;
    if (light_count > max_lights) {
        for (int i = 0; i < light_count; ++i) all += light_importance(lights[i], from);
    }
    for (int i = 0; i < light_count; ++i) {
        vec4 light = meet_light(lights[i], from, direction, far_of(hit));
        if (light.a <= 0.0) continue;
        float drawn = light.a * (all > 0.0 ? light_importance(lights[i], from) / all : 1.0);
        sums[k_punctual] += throughput * light.rgb * mis_weight(density, drawn);
    }
    if (hit.draw == k_nothing) {
        sums[k_sky] += throughput * environment(direction) * mis_weight(density, sky_density(direction));
    } else if (max(met.emission.r, max(met.emission.g, met.emission.b)) > 0.0) {
        sums[k_emitted] += throughput * met.emission * mis_weight(density, emitter_density(from, hit, met, direction));
    }
}

// A number of where everything lies, by which a scene that moves by itself is told from one that stands.
float scene_number() {
    uint bits = tree_texel(0u).w;
    for (int i = 0; i < light_count; ++i) {
        uvec3 place = floatBitsToUint(lights[i].position), turn = floatBitsToUint(lights[i].direction), power = floatBitsToUint(lights[i].intensity);
        for (int k = 0; k < 3; ++k) bits = hash_combine(bits, place[k] ^ hash_combine(turn[k], power[k]));
    }
    return float((bits & 0xffffffu) + 1u);
}

struct Way { // the first ray of a path
    vec3 direction, weight;
    float density; // 0: there is none
    uint coverage;
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution)) || frame_index < 0) return; // each frame adds: what reads its number runs in each
    vec4 mean = imageLoad(out_direct, pixel);
    float scene = scene_number();
    if (imageLoad(out_emission, pixel).a != scene) mean = vec4(0.0); // what moves leaves no trail
    uint taken = uint(mean.a);
    uint own = hash_combine(hash_combine(hash_combine(uint(seed), taken & 1u), uint(pixel.x)), uint(pixel.y));
    PixelSampler chances = pixel_sampler(own, taken >> 1);
    bool later_orders = bounces != 0, to_meet = anything_to_meet();

    vec3 emission = vec3(0.0), indirect[3] = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0)); // by path
    vec3 first[3] = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0));                          // by kind
    mat3 basis = mat3(camera_right, camera_up, camera_forward);
    vec3 direction = camera_ray(basis, tan_half_vfov, vec2(resolution), vec2(pixel) + next_pair(chances));
    vec3 origin = camera_position + direction * (near_plane / dot(direction, camera_forward));
    vec3 from = origin; // the surface that the ray leaves, without its offset
    uint coverage = sampler_key(chances, k_camera_ray);
    vec3 throughput = vec3(1.0), radiance[3] = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0));
    float density = 0.0;
    int path = k_before, depth = 0;
    Way gloss = Way(vec3(0.0), vec3(0.0), 0.0, 0u);
    vec3 gloss_origin = vec3(0.0), gloss_from = vec3(0.0), weight = vec3(0.0); // of the path in its part
    bool going = true;
    while (going) {
        TracedHit hit = trace_nearest(origin, direction, 3.0e38, coverage);
        TracedSurface s;
        s.emission = vec3(0.0);
        if (hit.draw != k_nothing) s = surface_at(hit, direction, k_with_normal_maps | k_with_emission);
        bool ends = hit.draw == k_nothing;
        if (path == k_before) {
            emission = ends ? environment(direction) : s.emission;
        } else if (depth == 0) {
            meet_lights(from, direction, hit, s, density, k_all_lights_at_camera, weight, first);
            ends = ends || !later_orders;
        } else {
            meet_lights(from, direction, hit, s, density, k_all_lights, throughput, radiance);
            ends = ends || depth == bounces;
        }
        if (!ends) {
            Lobes lobes = lobes_of(s, -direction);
            if (path != k_before && !glossy_secondary) lobes = without_gloss(lobes);
            vec2 u = vec2(0.0), v = vec2(0.0); // at the visible surface the diffuse lobe's and the other's, else also choices
            if (path != k_before) {
                ++depth;
                start_block(chances, uint(path + 2 * depth));
            }
            u = next_pair(chances);
            v = next_pair(chances);
            uint diffuse_coverage = sampler_key(chances, k_diffuse_ray), gloss_coverage = sampler_key(chances, k_gloss_ray);
            if (path == k_before) sample_lights(s, lobes, true, vec3(1.0), chances, first);
            else sample_lights(s, lobes, false, throughput, chances, radiance);
            origin = start_off(s);
            from = s.position;
            if (path == k_before) {
                Way diffuse = Way(draw_diffuse(lobes, u), vec3(0.0), 0.0, diffuse_coverage);
                float nl = dot(lobes.n, diffuse.direction);
                if (nl > 0.0 && above(s, diffuse.direction) && (later_orders || to_meet)) {
                    diffuse.weight = k_pi * diffuse_lobe(lobes.n, lobes.v, diffuse.direction, s.base_colour, s.metallic, s.roughness);
                    diffuse.density = nl / k_pi;
                }
                if (lobes.glossy) {
                    gloss.direction = draw_gloss(lobes, v);
                    nl = dot(lobes.n, gloss.direction);
                    vec4 toward = gloss_toward(lobes, gloss.direction);
                    if (nl > 0.0 && above(s, gloss.direction) && toward.a > 0.0 && (later_orders || to_meet)) {
                        gloss.weight = toward.rgb * (nl / toward.a);
                        gloss.density = toward.a;
                        gloss.coverage = gloss_coverage;
                        gloss_origin = origin;
                        gloss_from = from;
                    }
                }
                direction = diffuse.direction;
                weight = diffuse.weight;
                density = diffuse.density;
                coverage = diffuse.coverage;
                path = k_diffuse_path;
                ends = density <= 0.0;
            } else {
                ends = depth == bounces && !to_meet;
                direction = v.x < lobes.gloss_share ? draw_gloss(lobes, u) : draw_diffuse(lobes, u);
                float nl = dot(lobes.n, direction);
                vec4 f = both_toward(s, lobes, direction);
                ends = ends || nl <= 0.0 || !above(s, direction) || !(f.a > 0.0);
                if (!ends) {
                    throughput *= f.rgb * (nl / f.a);
                    density = f.a;
                    if (depth >= roulette_depth) {
                        float most = max(throughput.r, max(throughput.g, throughput.b));
                        float survival = min(depth >= k_long_path ? 0.95 : 1.0, most / k_roulette_throughput);
                        ends = !(v.y < survival);
                        throughput /= max(survival, 1.0e-20);
                    }
                    coverage = sampler_key(chances, k_diffuse_ray);
                }
            }
        }
        if (ends) {
            if (path != k_before) indirect[path] = weight * (radiance[0] + radiance[1] + radiance[2]);
            going = path == k_diffuse_path && gloss.density > 0.0;
            path = k_gloss_path;
            depth = 0;
            radiance = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0));
            throughput = vec3(1.0);
            origin = gloss_origin;
            from = gloss_from;
            direction = gloss.direction;
            weight = gloss.weight;
            density = gloss.density;
            coverage = gloss.coverage;
        }
    }

    float share = 1.0 / (mean.a + 1.0), count = mean.a + 1.0;
    imageStore(out_direct, pixel, vec4(mix(mean.rgb, first[k_punctual], share), count));
    imageStore(out_emitted, pixel, vec4(mix(imageLoad(out_emitted, pixel).rgb, first[k_emitted], share), count));
    imageStore(out_environment, pixel, vec4(mix(imageLoad(out_environment, pixel).rgb, first[k_sky], share), count));
    imageStore(out_indirect_diffuse, pixel, vec4(mix(imageLoad(out_indirect_diffuse, pixel).rgb, indirect[k_diffuse_path], share), count));
    imageStore(out_indirect_specular, pixel, vec4(mix(imageLoad(out_indirect_specular, pixel).rgb, indirect[k_gloss_path], share), count));
    imageStore(out_emission, pixel, vec4(mix(imageLoad(out_emission, pixel).rgb, emission, share), scene));
}
