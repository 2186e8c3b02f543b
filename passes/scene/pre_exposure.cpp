#include "scene/pre_exposure.h"

#include <algorithm>
#include <cmath>

namespace bounce {

namespace {

constexpr double k_pi = 3.14159265358979323846;
/// Surfaces are seldom nearer to a lamp than this share of the scene's diagonal.
constexpr double k_near_share = 0.01;
/// Suns, emitters and environments have no such near side; as much is left above them for highlights.
constexpr double k_headroom = 64;
constexpr int k_target = 10;              ///< log2 of the brightest likely radiance, stored
constexpr int k_dimmest = 2, k_most = 12; ///< log2 of radiance that is stored as it is

double brightest(const glm::vec3& colour) {
    return std::max({double(colour.r), double(colour.g), double(colour.b)});
}

/// The radiance of a white surface near the light.
double near_radiance(const Light& light, double scene_diagonal) {
    if (light.type == LightType::directional) return k_headroom * brightest(light.intensity) / k_pi;
    const double distance = k_near_share * (scene_diagonal > 0 ? scene_diagonal : 1);
    return brightest(light.intensity) / (distance * distance * k_pi);
}

} // namespace

float pre_exposure(const SceneState& state, const std::vector<Material>& materials, const Environment& environment,
                   float scene_diagonal) {
    double lit = 0, emitted = 0, around = 0;
    for (const Light& light : state.lights)
        lit += near_radiance(light, scene_diagonal);
    for (const Instance& instance : state.instances)
        emitted = std::max(emitted, brightest(materials[size_t(instance.primitive.material)].emission));
    if (environment.present()) {
        double texel = environment.map.empty() ? 1 : 0;
        for (float value : environment.map.pixels)
            if (std::isfinite(value)) texel = std::max(texel, double(value));
        around = brightest(environment.radiance) * texel;
    }
    const double most = lit + k_headroom * (emitted + around);
    if (!(most > 0) || !std::isfinite(most)) return 1;
    const int stops = int(std::lround(std::log2(most)));
    if (stops >= k_dimmest && stops <= k_most) return 1;
    return std::exp2(float(std::clamp(k_target - stops, -120, 120)));
}

} // namespace bounce
