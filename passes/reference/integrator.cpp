#include "reference/integrator.h"

#include "scene/camera_ray.h"
#include "scene/lobe_albedo.h"

#include <limits>

namespace bounce {

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
/// Up to so many lights are all asked, beyond that one of them is drawn. The visible surface, where noise is seen, asks
/// more.
constexpr size_t k_all_lights_at_camera = 16;
constexpr size_t k_all_lights = 4;

/// Which part a light's first scattering belongs to.
enum Kind { k_punctual, k_emitted, k_environment };

/// Rays that may be traced at one point of a sampler's sequence; the lights' come last.
enum CoverageRay : uint32_t { k_camera_ray, k_diffuse_ray, k_gloss_ray, k_emitter_ray, k_sky_ray, k_light_ray };

} // namespace

/// The surface's two lobes as seen from one direction, ready to be evaluated and drawn from.
struct Integrator::Lobes {
    glm::vec3 n, v;
    glm::vec3 geometric;
    glm::vec3 lambert; ///< ρ/π
    glm::vec3 f0;
    float nv, alpha, roughness;
    bool glossy;
    MaterialModel model;
    glm::vec3 limit{1}; ///< of the diffuse lobe, seen from v
    Basis basis;

    Lobes(const Surface& surface, const glm::vec3& to_viewer, const TraceScene& scene, bool microfacets)
        : n(surface.shading), v(to_viewer), geometric(surface.geometric),
          lambert(brdf_diffuse(surface.base_colour, surface.metallic)),
          f0(brdf_f0(surface.base_colour, surface.metallic)), nv(glm::dot(n, v)), alpha(brdf_alpha(surface.roughness)),
          roughness(surface.roughness), glossy(microfacets && nv > 0), model(scene.material_model), basis(n) {
        if (model == MaterialModel::gltf && nv > 0) limit = diffuse_limit(k_pi * lambert, f0, roughness, nv);
    }

    /// The diffuse lobe toward l, nl = n·l above 0.
    glm::vec3 diffuse(const glm::vec3& l, float nl) const {
        if (model == MaterialModel::plain) return lambert;
        const glm::vec3 weighted = lambert * fresnel_diffuse_weight(v, glm::normalize(v + l));
        if (model == MaterialModel::appendix_b || nv <= 0) return weighted;
        return weighted * glm::min(limit, diffuse_limit(k_pi * lambert, f0, roughness, nl));
    }

    struct Gloss {
        glm::vec3 value{0};
        float density = 0;
    };
    /// The microfacet lobe (brdf_specular) with its sampling density, which share most of their terms.
    Gloss gloss(const glm::vec3& l, float nl) const {
        Gloss g;
        if (!glossy || nl <= 0) return g;
        const glm::vec3 h = glm::normalize(v + l);
        const float d = ggx_density(n, h, alpha);
        const glm::vec3 fresnel = f0 + (1.0f - f0) * schlick_weight(v, h);
        g.value = fresnel * (d * smith_visibility(nl, nv, alpha));
        g.density = visible_normal_density(d, nv, alpha);
        return g;
    }
    glm::vec3 draw_diffuse(const glm::vec2& u) const { return basis.to_world(cosine_hemisphere(u)); }
    glm::vec3 draw_gloss(const glm::vec2& u) const {
        const glm::vec3 h = basis.to_world(visible_normal(basis.to_local(v), alpha, u));
        return glm::normalize(2.0f * glm::dot(v, h) * h - v);
    }
    /// Light from below the surface itself is blocked by it, whatever the shading normal says.
    bool above(const glm::vec3& l) const { return glm::dot(geometric, l) > 0; }
};

TraceScene::TraceScene(const Shot& shot, const ShotState& state, const ReferenceSettings& s)
    : geometry(shot, state.scene, shot.diffuse_only), emitters(geometry), environment(shot.environment),
      lights(state.scene.lights), camera(state.camera),
      camera_basis(bounce::camera_basis(camera.position, camera.target, camera.up)),
      tan_half_vfov(std::tan(0.5f * camera.vfov)), size(float(shot.width), float(shot.height)), settings(s),
      diffuse_only(s.diffuse_only || shot.diffuse_only), material_model(shot.effective_model()),
      occlusion_distance(s.occlusion_distance * shot_facts(shot).bounds_over_animation.diagonal()) {}

float TraceScene::near_visibility(float distance) const {
    const float share = distance / occlusion_distance;
    if (share >= 1) return 1;
    return settings.occlusion_falloff == OcclusionFalloff::quadratic ? share * share : 0;
}

bool TraceScene::anything_to_meet() const {
    return environment.present() || !emitters.empty() || lights.any_soft();
}

Hit Integrator::trace(const glm::vec3& origin, const glm::vec3& direction, uint32_t coverage_seed) {
    ++rays_;
    if (record_) record_->push_back({origin, k_infinity, direction, false});
    return scene_.geometry.intersect(origin, direction, k_infinity, coverage_seed);
}

bool Integrator::blocked(const glm::vec3& origin, const glm::vec3& to_end, float length, uint32_t coverage_seed) {
    ++rays_;
    if (record_) record_->push_back({origin, length, to_end, true});
    return scene_.geometry.occluded(origin, to_end, length, coverage_seed);
}

float Integrator::light_probability(size_t i, const Place& x) const {
    float sum = 0;
    for (size_t j = 0; j < scene_.lights.size(); ++j)
        sum += scene_.lights.importance(j, x);
    return sum > 0 ? scene_.lights.importance(i, x) / sum : 0;
}

/// Next-event estimation: for each light (or drawn light) that reaches the surface, calls
/// add(kind, l, irradiance at normal incidence ÷ density, density per solid angle, 0 for a hard light).
template <class Add>
void Integrator::sample_lights(const Surface& surface, PixelSampler& sampler, size_t max_lights, Add&& add) {
    const glm::vec3 origin = surface.origin();
    const PunctualLights& lights = scene_.lights;
    auto from_light = [&](size_t i, float probability) {
        const glm::vec2 u = lights.any_soft() ? sampler.next_pair() : glm::vec2(0);
        const PunctualLights::Sample s = lights.sample(i, surface.place, u);
        if (glm::dot(s.direction, surface.geometric) <= 0 || glm::dot(s.direction, surface.shading) <= 0) return;
        if (s.irradiance == glm::vec3(0)) return;
        // To where the surface itself looks at, and a little short of it, in case the light touches a surface.
        const bool near = s.distance < k_infinity;
        const glm::vec3 to_end = near ? s.direction * s.distance - surface.offset * surface.geometric : s.direction;
        if (blocked(origin, to_end, near ? 1 - 1e-6f : k_infinity, coverage_seed(sampler, k_light_ray + uint32_t(i))))
            return;
        add(k_punctual, s.direction, s.irradiance / probability, s.density * probability);
    };
    if (lights.size() <= max_lights) {
        for (size_t i = 0; i < lights.size(); ++i)
            from_light(i, 1);
    } else {
        float sum = 0, before = 0;
        for (size_t i = 0; i < lights.size(); ++i)
            sum += lights.importance(i, surface.place);
        const float target = sampler.next() * sum;
        for (size_t i = 0; sum > 0 && i < lights.size(); ++i) {
            const float importance = lights.importance(i, surface.place);
            before += importance;
            if (before <= target || importance <= 0) continue;
            from_light(i, importance / sum);
            break;
        }
    }
    if (!scene_.emitters.empty()) {
        const float choice = sampler.next();
        const Emitters::Sample s = scene_.emitters.sample(scene_.geometry, surface.place, choice, sampler.next_pair());
        if (s.density > 0 && s.radiance != glm::vec3(0) && glm::dot(s.direction, surface.geometric) > 0 &&
            glm::dot(s.direction, surface.shading) > 0) {
            if (!blocked(origin, s.position - origin, 1, coverage_seed(sampler, k_emitter_ray)))
                add(k_emitted, s.direction, s.radiance / s.density, s.density);
        }
    }
    if (scene_.environment.sampled()) {
        const float choice = sampler.next();
        float density;
        const glm::vec3 l = scene_.environment.sample(choice, sampler.next_pair(), density);
        if (glm::dot(l, surface.geometric) > 0 && glm::dot(l, surface.shading) > 0) {
            const glm::vec3 radiance = scene_.environment.radiance(l);
            if (radiance != glm::vec3(0) && !blocked(origin, l, k_infinity, coverage_seed(sampler, k_sky_ray))) {
                add(k_environment, l, radiance / density, density);
            }
        }
    }
}

/// What a ray drawn from a lobe meets by itself, weighted against next-event estimation: add(kind, radiance).
template <class Add>
void Integrator::meet_lights(const Place& origin, const glm::vec3& direction, const Hit& hit, float own_density,
                             size_t max_lights, Add&& add) {
    scene_.lights.meet(origin, direction, hit.valid() ? hit.distance : k_infinity,
                       [&](size_t i, const glm::vec3& radiance, float density) {
                           if (scene_.lights.size() > max_lights) density *= light_probability(i, origin);
                           add(k_punctual, radiance * mis_weight(own_density, density));
                       });
    if (!hit.valid()) {
        if (!scene_.environment.present()) return;
        add(k_environment,
            scene_.environment.radiance(direction) * mis_weight(own_density, scene_.environment.density(direction)));
        return;
    }
    const TraceGeometry::Geometry& mesh = scene_.geometry.geometries()[hit.geometry];
    if (!scene_.geometry.emissive(mesh)) return;
    const glm::vec3 emission = scene_.geometry.emission(mesh, hit.triangle, hit.u, hit.v);
    if (emission == glm::vec3(0)) return;
    add(k_emitted,
        emission * mis_weight(own_density, scene_.emitters.density(scene_.geometry, origin, hit, direction)));
}

/// A path beyond the visible surface: what the surface at `hit` scatters back along `direction` is being summed.
struct Integrator::Path {
    PixelSampler sampler;
    uint32_t block; ///< 1 for the diffuse path of a sample, 2 for the glossy one: they draw from different dimensions
    Hit hit;
    glm::vec3 direction;
    glm::vec3 radiance{0}, throughput{1};
    int depth = 1;
    PixelSample* out;
    glm::vec3 weight; ///< of the radiance in out.indirect_diffuse or out.indirect_specular
    bool done = false;
};

Integrator::Integrator(const TraceScene& scene) : scene_(scene) {}
Integrator::~Integrator() = default;

/// Scatters the path at its present surface and traces it on. Returns false at its end.
bool Integrator::extend(Path& path, const Surface& surface) {
    const int bounces = scene_.settings.bounces;
    path.sampler.start_block(path.block + uint32_t(2 * path.depth));
    const glm::vec2 u = path.sampler.next_pair(), chances = path.sampler.next_pair();
    const float choice = chances.x, survival = chances.y;

    const Lobes lobes(surface, -path.direction, scene_, !scene_.diffuse_only && !scene_.settings.diffuse_secondary);
    float gloss_share = 0;
    if (lobes.glossy) {
        // Schlick at the viewing angle is near enough for a choice between lobes.
        const float m = 1 - std::min(lobes.nv, 1.0f), m2 = m * m;
        const float specular = luminance(lobes.f0 + (1.0f - lobes.f0) * (m2 * m2 * m));
        const float diffuse = luminance(lobes.lambert) * k_pi;
        gloss_share = diffuse > 0 ? std::clamp(specular / (specular + diffuse), 0.1f, 0.9f) : 1.0f;
    }
    auto evaluate = [&](const glm::vec3& l, float nl, float& density) {
        const Lobes::Gloss gloss = lobes.gloss(l, nl);
        density = gloss_share * gloss.density + (1 - gloss_share) * nl / k_pi;
        return lobes.diffuse(l, nl) + gloss.value;
    };
    sample_lights(
        surface, path.sampler, k_all_lights, [&](Kind, const glm::vec3& l, const glm::vec3& irradiance, float density) {
            const float nl = glm::dot(lobes.n, l);
            float own;
            const glm::vec3 f = evaluate(l, nl, own);
            path.radiance += path.throughput * f * irradiance * (nl * (density > 0 ? mis_weight(density, own) : 1));
        });

    const bool last = bounces != k_unlimited_bounces && path.depth == bounces;
    if (last && !scene_.anything_to_meet()) return false;
    const glm::vec3 l = choice < gloss_share ? lobes.draw_gloss(u) : lobes.draw_diffuse(u);
    const float nl = glm::dot(lobes.n, l);
    if (nl <= 0 || !lobes.above(l)) return false;
    float density;
    const glm::vec3 f = evaluate(l, nl, density);
    if (!(density > 0)) return false;
    path.throughput *= f * (nl / density);
    if (path.depth >= scene_.settings.roulette_depth) {
        const float most = std::max(path.throughput.r, std::max(path.throughput.g, path.throughput.b));
        const float probability = std::min(path.depth >= k_long_path ? 0.95f : 1.0f, most / k_roulette_throughput);
        if (!(survival < probability)) return false;
        path.throughput /= probability;
    }
    const glm::vec3 origin = surface.origin();
    path.hit = trace(origin, l, coverage_seed(path.sampler, k_diffuse_ray));
    scene_.geometry.prefetch_indices(path.hit);
    meet_lights(surface.place, l, path.hit, density, k_all_lights,
                [&](Kind, const glm::vec3& met) { path.radiance += path.throughput * met; });
    path.direction = l;
    ++path.depth;
    return path.hit.valid() && !last;
}

/// Follows all paths to their ends, all of them one surface further in each round: each step over all paths fetches
/// what the next step reads.
void Integrator::follow(std::vector<Path>& paths) {
    TraceGeometry::SurfacePlace places[2 * k_max_together];
    size_t running = paths.size();
    while (running > 0) {
        for (const Path& path : paths) {
            if (!path.done) scene_.geometry.prefetch_corners(path.hit);
        }
        for (size_t i = 0; i < paths.size(); ++i) {
            if (!paths[i].done) places[i] = scene_.geometry.find_surface(paths[i].hit);
        }
        for (size_t i = 0; i < paths.size(); ++i) {
            Path& path = paths[i];
            if (path.done) continue;
            if (extend(path, scene_.geometry.read_surface(places[i], path.hit, path.direction))) continue;
            path.done = true;
            --running;
        }
    }
}

namespace {

float* part_of(PixelSample& sample, int index) {
    return &sample[size_t(k_reference_parts[size_t(index)].offset)];
}

void add(float* sum, const glm::vec3& value) {
    for (int c = 0; c < 3; ++c)
        sum[c] += value[c];
}

} // namespace

/// The camera ray and all that is scattered once; leaves the first rays of the later orders in `paths`.
void Integrator::begin(int x, int y, PixelSampler& sampler, PixelSample& out, std::vector<Path>& paths) {
    out.fill(0);
    // First scatterings by kind: out.direct, out.emitted, out.environment, and the same as irradiance.
    auto add_first = [&](Kind kind, const glm::vec3& radiance) { add(part_of(out, kind), radiance); };
    auto add_irradiance = [&](Kind kind, const glm::vec3& irradiance) { add(part_of(out, 6 + kind), irradiance); };
    float* const emission = part_of(out, 5);
    float& open = *part_of(out, 10);
    float& open_near = *part_of(out, 11);

    sampler.start_block(0);
    const glm::vec2 jitter = sampler.next_pair();
    const glm::vec3 camera_direction =
        camera_ray(scene_.camera_basis, scene_.tan_half_vfov, scene_.size, glm::vec2(x, y) + jitter);
    const Hit first = trace(camera_ray_start(scene_.camera, scene_.camera_basis, camera_direction), camera_direction,
                            coverage_seed(sampler, k_camera_ray));
    if (!first.valid()) {
        if (scene_.environment.present()) add(emission, scene_.environment.radiance(camera_direction));
        open = open_near = 1;
        return;
    }
    const glm::vec2 u_diffuse = sampler.next_pair(), u_gloss = sampler.next_pair();
    const Surface surface = scene_.geometry.surface(first, camera_direction);
    const Lobes lobes(surface, -camera_direction, scene_, !scene_.diffuse_only);
    const glm::vec3 origin = surface.origin();
    const bool later_orders = scene_.settings.bounces != 0;
    add(emission, surface.emission);

    // The diffuse path also measures ambient occlusion: its first ray has the density cosθ/π.
    const glm::vec3 l = lobes.draw_diffuse(u_diffuse);
    if (const float nl = glm::dot(lobes.n, l); nl > 0 && lobes.above(l)) {
        const Hit hit = trace(origin, l, coverage_seed(sampler, k_diffuse_ray));
        if (later_orders) scene_.geometry.prefetch_indices(hit);
        open = hit.valid() ? 0.0f : 1.0f;
        open_near = hit.valid() ? scene_.near_visibility(hit.distance) : 1.0f;
        const glm::vec3 weight = lobes.diffuse(l, nl) * k_pi;
        meet_lights(surface.place, l, hit, nl / k_pi, k_all_lights_at_camera, [&](Kind kind, const glm::vec3& met) {
            add_irradiance(kind, k_pi * met);
            add_first(kind, weight * met);
        });
        if (later_orders && hit.valid()) {
            paths.push_back(
                {.sampler = sampler, .block = 1, .hit = hit, .direction = l, .out = &out, .weight = weight});
        }
    }
    if (lobes.glossy) {
        const glm::vec3 g = lobes.draw_gloss(u_gloss);
        const float nl = glm::dot(lobes.n, g);
        const Lobes::Gloss gloss = lobes.gloss(g, nl);
        if (nl > 0 && lobes.above(g) && gloss.density > 0 && (later_orders || scene_.anything_to_meet())) {
            const glm::vec3 weight = gloss.value * (nl / gloss.density);
            const Hit hit = trace(origin, g, coverage_seed(sampler, k_gloss_ray));
            if (later_orders) scene_.geometry.prefetch_indices(hit);
            meet_lights(surface.place, g, hit, gloss.density, k_all_lights_at_camera,
                        [&](Kind kind, const glm::vec3& met) { add_first(kind, weight * met); });
            if (later_orders && hit.valid()) {
                paths.push_back(
                    {.sampler = sampler, .block = 2, .hit = hit, .direction = g, .out = &out, .weight = weight});
            }
        }
    }
    sample_lights(surface, sampler, k_all_lights_at_camera,
                  [&](Kind kind, const glm::vec3& to_light, const glm::vec3& irradiance, float density) {
                      const float nl = glm::dot(lobes.n, to_light);
                      const Lobes::Gloss gloss = lobes.gloss(to_light, nl);
                      const float diffuse_weight = density > 0 ? mis_weight(density, nl / k_pi) : 1.0f;
                      const float gloss_weight = density > 0 ? mis_weight(density, gloss.density) : 1.0f;
                      const glm::vec3 e = irradiance * (nl * diffuse_weight);
                      add_irradiance(kind, e);
                      add_first(kind, lobes.diffuse(to_light, nl) * e + gloss.value * irradiance * (nl * gloss_weight));
                  });
}

void Integrator::sample(int x, int y, std::span<PixelSampler> samplers, std::span<PixelSample> out) {
    for (size_t first = 0; first < samplers.size(); first += k_max_together) {
        const size_t end = std::min(samplers.size(), first + k_max_together);
        paths_.clear();
        for (size_t i = first; i < end; ++i)
            begin(x, y, samplers[i], out[i], paths_);
        follow(paths_);
        for (const Path& path : paths_) {
            add(part_of(*path.out, path.block == 1 ? 3 : 4), path.weight * path.radiance);
            if (path.block == 1) add(part_of(*path.out, 9), k_pi * path.radiance);
        }
    }
}

PixelSurface Integrator::centre(int x, int y) {
    PixelSurface out;
    const glm::vec3 direction =
        camera_ray(scene_.camera_basis, scene_.tan_half_vfov, scene_.size, glm::vec2(x, y) + 0.5f);
    const glm::vec3 start = camera_ray_start(scene_.camera, scene_.camera_basis, direction);
    const Hit hit = scene_.geometry.intersect(start, direction, k_infinity);
    if (!hit.valid()) return out;
    const Surface surface = scene_.geometry.surface(hit, direction);
    out.hit = true;
    out.position = surface.place.position();
    out.normal = surface.shading;
    out.albedo = surface.base_colour;
    out.material = float(surface.material);
    out.roughness = surface.roughness;
    out.metallic = surface.metallic;
    out.distance = glm::distance(scene_.camera.position, start) + hit.distance;
    return out;
}

} // namespace bounce
