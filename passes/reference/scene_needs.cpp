#include "reference/scene_needs.h"

#include "scene/extent.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

// From a sweep over six shots (bounce table auto_values). What lights see is hit on the texels of their maps, so that
// twice as many voxels are hardly better. Fewer than 128 would be enough for small rooms, where they cost little.
constexpr double k_voxels_across = 5, k_least_voxels = 128, k_most_voxels = 256;
// What occludes is held by planes in voxels: half as many are as good.
constexpr double k_occluders_across = 5, k_least_occluders = 64, k_most_occluders = 128;
constexpr double k_texels_across = 64, k_least_texels = 256, k_most_texels = 1024;
constexpr double k_cones_by_variance = 6.5, k_least_cones = 16, k_most_cones = 48;
constexpr double k_proxies_across = 95, k_least_proxies = 24000, k_most_proxies = 200000;
// Of proxies that light reaches a texel's lists hold so many: in bright rooms more of them lose light again.
constexpr double k_most_lit_proxies = 22000;
constexpr double k_cells_across = 1.5, k_least_cells = 6, k_most_cells = 32;
// Light that is swept through cells bleeds through what is thinner than one. With 96 directions, 50³ cells are the most
// that a storage block of 128 MiB holds, the least that OpenGL promises.
constexpr double k_light_cells_across = 5.5, k_least_light_cells = 24, k_most_light_cells = 48;
// Where a map's texels are coarse beside the gaps, they make the error, and more axes take little of it away.
constexpr double k_axes_by_gap = 2000, k_least_axes = 256, k_most_axes = 512;

std::string limited(double wanted, double least, double most) {
    if (wanted < least) return fmt::format(", but no fewer than {:g}", least);
    return wanted > most ? fmt::format(", but no more than {:g}", most) : "";
}

/// `wanted` within its limits, with what it follows from and which limit it met.
Need need(double wanted, double least, double most, const std::string& why) {
    return {std::clamp(wanted, least, most), why + limited(wanted, least, most)};
}

double power_of_two(double number) {
    return std::exp2(std::ceil(std::log2(std::max(number, 1.0)) - 1e-9));
}

} // namespace

SceneNeeds needs_of(const FeatureSizes& f, float extent) {
    SceneNeeds needs;
    const double gap = f.gap_10 > 0 ? f.gap_10 : extent, gaps = extent > 0 ? extent / gap : 1;
    const std::string around = fmt::format("a tenth of what is seen has surfaces within {:.3g} m around it", gap);
    needs["voxels"] = need(power_of_two(k_voxels_across * gaps), k_least_voxels, k_most_voxels,
                           fmt::format("{}: {:g} voxels across", around, k_voxels_across));
    needs["occlusion_voxels"] = need(power_of_two(k_occluders_across * gaps), k_least_occluders, k_most_occluders,
                                     fmt::format("{}: {:g} voxels across", around, k_occluders_across));
    needs["map_texels"] = need(power_of_two(k_texels_across * gaps), k_least_texels, k_most_texels,
                               fmt::format("{}: {:g} texels across", around, k_texels_across));
    const double most_proxies = f.lit_share > 0 ? k_most_lit_proxies / f.lit_share : k_most_proxies;
    needs["proxies"] = need(k_proxies_across * f.area / (gap * gap), k_least_proxies,
                            std::clamp(most_proxies, k_least_proxies, k_most_proxies),
                            fmt::format("{}, and all surfaces are {:.3g} m²: {:g} proxies in a square of that size",
                                        around, f.area, k_proxies_across));
    needs["cells"] = need(std::ceil(k_cells_across * gaps), k_least_cells, k_most_cells,
                          fmt::format("{}: {:g} cells across", around, k_cells_across));
    needs["light_cells"] = need(std::ceil(k_light_cells_across * gaps), k_least_light_cells, k_most_light_cells,
                                fmt::format("{}: {:g} cells across", around, k_light_cells_across));
    needs["axes"] = need(std::round(k_axes_by_gap / gaps), k_least_axes, k_most_axes,
                         fmt::format("{}: {:g} axes over the scene's length in such gaps", around, k_axes_by_gap));
    needs["cones"] = need(std::round(k_cones_by_variance * f.ray_variance), k_least_cones, k_most_cones,
                          fmt::format("what one ray brings varies by {:.2g} times its mean, {:.2g} % of the directions "
                                      "meet lit surfaces",
                                      std::sqrt(f.ray_variance), 100 * f.lit_share));
    return needs;
}

SceneNeeds scene_needs(const Shot& shot) {
    return needs_of(measure_features(shot), longest_edge(shot_facts(shot).bounds_over_animation));
}

} // namespace bounce
