#pragma once
// One path-traced sample of a pixel: unidirectional, next-event estimation and lobe sampling joined by multiple
// importance sampling (Veach 1997). At the visible surface both lobes are followed by a path of their own, which keeps
// the parts apart.

#include "core/low_discrepancy.h"
#include "reference/emitters.h"
#include "reference/environment_light.h"
#include "reference/geometry.h"
#include "reference/punctual_lights.h"
#include "reference/settings.h"

#include <array>
#include <span>
#include <vector>

namespace bounce {

/// All that light transport needs of a shot at one frame; immutable.
struct TraceScene {
    TraceScene(const Shot& shot, const ShotState& state, const ReferenceSettings& settings);

    TraceGeometry geometry;
    Emitters emitters;
    EnvironmentLight environment;
    PunctualLights lights;
    Camera camera;
    glm::mat3 camera_basis;
    float tan_half_vfov;
    glm::vec2 size;
    ReferenceSettings settings;
    bool diffuse_only; ///< no microfacet lobe
    MaterialModel material_model;
    float occlusion_distance; ///< metres

    /// The visibility that out.ambient_occlusion_dmax takes of an occluder at `distance`.
    float near_visibility(float distance) const;

    /// Whether a ray drawn from a lobe can meet light by itself.
    bool anything_to_meet() const;
};

/// The channels of k_reference_parts, in their order.
using PixelSample = std::array<float, k_reference_channels>;

/// What the camera sees at a pixel's centre.
struct PixelSurface {
    bool hit = false;
    glm::vec3 position{0}, normal{0}, albedo{0};
    float material = -1, roughness = 0, metallic = 0, distance = 0;
};

class Integrator {
  public:
    explicit Integrator(const TraceScene& scene);
    ~Integrator();

    /// One sample of the pixel for each sampler. Samples do not depend on which others are taken with them; taking some
    /// together is faster.
    static constexpr int k_max_together = 8;
    void sample(int x, int y, std::span<PixelSampler> samplers, std::span<PixelSample> out);
    PixelSurface centre(int x, int y);

    uint64_t rays() const { return rays_; }
    /// Every ray traced from now on is appended to `record` (null: none).
    void record_rays(std::vector<TracedRay>* record) { record_ = record; }

  private:
    struct Lobes;
    struct Path;
    Hit trace(const glm::vec3& origin, const glm::vec3& direction, uint32_t coverage_seed);
    bool blocked(const glm::vec3& origin, const glm::vec3& to_end, float length, uint32_t coverage_seed);
    /// Of a ray that is traced at this point of the sampler's sequence; `which` tells rays of one point apart.
    uint32_t coverage_seed(const PixelSampler& sampler, uint32_t which) const {
        return scene_.geometry.blended() ? sampler.key(which) : 0;
    }
    template <class Add>
    void sample_lights(const Surface& surface, PixelSampler& sampler, size_t max_lights, Add&& add);
    template <class Add>
    void meet_lights(const Place& origin, const glm::vec3& direction, const Hit& hit, float own_density,
                     size_t max_lights, Add&& add);
    void begin(int x, int y, PixelSampler& sampler, PixelSample& out, std::vector<Path>& paths);
    void follow(std::vector<Path>& paths);
    bool extend(Path& path, const Surface& surface);
    float light_probability(size_t i, const Place& x) const;

    const TraceScene& scene_;
    uint64_t rays_ = 0;
    std::vector<Path> paths_;
    std::vector<TracedRay>* record_ = nullptr;
};

} // namespace bounce
