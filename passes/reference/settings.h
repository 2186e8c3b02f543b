#pragma once
// What the reference computes, and the parts it computes apart.

#include <array>
#include <string>
#include <string_view>

namespace bounce {

constexpr int k_unlimited_bounces = -1;
constexpr float k_roulette_throughput = 0.1f;
/// From here on every bounce has a chance of being the last, so that paths end where nothing absorbs.
constexpr int k_long_path = 64;

/// How an occluder at distance d < d_max counts in out.ambient_occlusion_dmax: fully (the obscurance of the LDM paper's
/// d_max), or by W = 1 − (d/d_max)² (HBAO's attenuation). Beyond d_max none does.
enum class OcclusionFalloff { none, quadratic };
constexpr std::array<std::string_view, 2> k_occlusion_falloffs{"none", "quadratic"};

struct ReferenceSettings {
    int bounces = k_unlimited_bounces; ///< scattering orders after the first; 0 = the first only, −1 = all
    /// No microfacet lobe: the diffuse lobe of the shot's material model alone, which is Lambert with
    /// ρ = base colour·(1 − metallic) in the plain one. (A shot's own flag makes every material Lambert.)
    bool diffuse_only = false;
    /// Surfaces behind the visible one have their diffuse lobe alone, which is what methods that store light as diffuse
    /// radiosity (voxels, photons, point lights) model. The visible surface keeps both.
    bool diffuse_secondary = false;
    float occlusion_distance = 0.1f; ///< d_max of out.ambient_occlusion_dmax, as a share of the scene's diagonal
    OcclusionFalloff occlusion_falloff = OcclusionFalloff::none;
    /// Paths end by Russian roulette (unbiased) only after this many bounces, and only when their throughput has fallen
    /// below k_roulette_throughput, to which the survivors are raised again.
    int roulette_depth = 3;
    bool stratified = true; ///< Owen-scrambled Sobol points; off: independent random numbers
    unsigned seed = 0;      ///< renders of different seeds are independent

    // What does not change the result:
    int threads = 0; ///< 0 = all
};

/// One of the images the reference makes. Names and meanings are the ground rules' (out.*); `irradiance.*` is what
/// arrives at the visible surface as irradiance (W/m²), so without albedo, split like the first four.
struct ReferencePart {
    std::string_view name;
    int channels;
    int offset; ///< of its first channel in a pixel's sums
};
/// out.radiance is not among them: it is the sum of the first six.
constexpr std::array<ReferencePart, 12> k_reference_parts{{
    {"out.direct", 3, 0},
    {"out.emitted", 3, 3},
    {"out.environment", 3, 6},
    {"out.indirect_diffuse", 3, 9},
    {"out.indirect_specular", 3, 12},
    {"out.emission", 3, 15},
    {"irradiance.direct", 3, 18},
    {"irradiance.emitted", 3, 21},
    {"irradiance.environment", 3, 24},
    {"irradiance.indirect", 3, 27},
    {"out.ambient_occlusion", 1, 30},
    {"out.ambient_occlusion_dmax", 1, 31},
}};
constexpr int k_reference_channels = 32;
constexpr int k_radiance_parts = 6;

/// Part of every cache key: to be raised whenever a change in the tracer changes its results.
constexpr std::string_view k_tracer_version = "2";

} // namespace bounce
