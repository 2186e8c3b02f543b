#include "reference/feature_sizes.h"

#include "core/low_discrepancy.h"
#include "reference/geometry.h"
#include "reference/punctual_lights.h"
#include "scene/camera_ray.h"

#include <algorithm>
#include <limits>

namespace bounce {

namespace {

constexpr int k_columns = 48, k_rows = 27; ///< camera rays of one view
constexpr int k_rays = 16;                 ///< from each point that is seen
constexpr size_t k_max_views = 4, k_max_lights = 16;
constexpr float k_infinity = std::numeric_limits<float>::infinity();

std::vector<Camera> views_of(const Shot& shot, const Camera& first) {
    std::vector<Camera> views;
    const auto& keys = shot.camera_path.keys;
    const size_t count = std::min(keys.size(), k_max_views);
    for (size_t i = 0; i < count; ++i) {
        const PathKey& key = keys[i * (keys.size() - 1) / std::max<size_t>(count - 1, 1)];
        views.push_back(first);
        views.back().position = shot.scene.space.to_loaded(key.position);
        views.back().target = shot.scene.space.to_loaded(key.target);
    }
    if (views.empty()) views.push_back(first);
    return views;
}

float share_below(std::vector<float>& sorted, double share) {
    return sorted.empty() ? 0 : sorted[std::min(sorted.size() - 1, size_t(share * double(sorted.size())))];
}

/// Luminance that the surface sends on of what the lights shine on it, as radiance. Of many lights some stand for all;
/// `point` says which, so that the rays of one point see the same ones.
float reflected_light(const TraceGeometry& geometry, const PunctualLights& lights, const Surface& surface,
                      uint32_t point) {
    const size_t step = std::max<size_t>(1, (lights.size() + k_max_lights - 1) / k_max_lights);
    float sum = luminance(surface.emission);
    const float albedo = luminance(surface.base_colour) * (1 - surface.metallic);
    for (size_t i = hash_u32(point) % step; i < lights.size(); i += step) {
        const PunctualLights::Sample s = lights.sample(i, surface.place, glm::vec2(0.5f));
        const float cosine = glm::dot(s.direction, surface.geometric);
        if (cosine <= 0 || s.irradiance == glm::vec3(0)) continue;
        const bool near = s.distance < k_infinity;
        const glm::vec3 to_end = near ? s.direction * s.distance - surface.offset * surface.geometric : s.direction;
        if (geometry.occluded(surface.origin(), to_end, near ? 1 - 1e-6f : k_infinity)) continue;
        sum += float(step) * albedo * luminance(s.irradiance) * cosine / k_pi;
    }
    return sum;
}

} // namespace

FeatureSizes measure_features(const Shot& shot) {
    const ShotState state = evaluate_shot(shot, 0);
    const TraceGeometry geometry(shot, state.scene, true);
    const PunctualLights lights(state.scene.lights);
    FeatureSizes features;
    for (const TraceGeometry::Geometry& part : geometry.geometries())
        for (uint32_t t = 0; t < part.triangle_count(); ++t)
            features.area += glm::length(triangle_cross(part, t)) / 2;

    std::vector<float> gaps;
    double rays = 0, lit = 0, weight = 0, variance = 0;
    const glm::vec2 size(k_columns, k_rows);
    for (const Camera& camera : views_of(shot, state.camera)) {
        const glm::mat3 basis = camera_basis(camera.position, camera.target, camera.up);
        for (int i = 0; i < k_columns * k_rows; ++i) {
            const glm::vec2 pixel(float(i % k_columns) + 0.5f, float(i / k_columns) + 0.5f);
            const glm::vec3 direction = camera_ray(basis, std::tan(camera.vfov / 2), size, pixel);
            const Hit seen = geometry.intersect(camera_ray_start(camera, basis, direction), direction, k_infinity);
            if (!seen.valid()) continue;
            const Surface surface = geometry.surface(seen, direction);
            const Basis around(surface.geometric);
            std::vector<float> free;
            double sum = 0, squares = 0;
            for (int r = 0; r < k_rays; ++r) {
                PixelSampler of_ray(hash_u32(uint32_t(features.points)), uint32_t(r), true);
                const glm::vec3 out = around.to_world(cosine_hemisphere(of_ray.next_pair()));
                const Hit hit = geometry.intersect(surface.origin(), out, k_infinity);
                free.push_back(hit.valid() ? hit.distance : k_infinity);
                const float light = hit.valid() ? reflected_light(geometry, lights, geometry.surface(hit, out),
                                                                  uint32_t(features.points))
                                                : 0;
                lit += light > 0;
                sum += light;
                squares += double(light) * light;
            }
            rays += k_rays;
            const double mean = sum / k_rays;
            if (mean > 0) {
                // Unbiased; weighted by the point's light, as an error of the picture is.
                const double own = (squares / k_rays - mean * mean) * k_rays / (k_rays - 1);
                variance += own;
                weight += mean * mean;
            }
            std::nth_element(free.begin(), free.begin() + k_rays / 2, free.end());
            if (free[k_rays / 2] < k_infinity) gaps.push_back(free[k_rays / 2]);
            ++features.points;
        }
    }
    std::sort(gaps.begin(), gaps.end());
    features.gap_10 = share_below(gaps, 0.1);
    features.gap_50 = share_below(gaps, 0.5);
    features.lit_share = rays > 0 ? float(lit / rays) : 0;
    features.ray_variance = weight > 0 ? float(variance / weight) : 0;
    return features;
}

} // namespace bounce
