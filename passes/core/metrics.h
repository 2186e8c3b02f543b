#pragma once
// How far an image is from a reference. Figures on linear values are computed in double over unmasked pixels and all
// channels; `test` is a and `reference` is b. Images of different sizes or channel counts, an empty mask, and NaN or
// infinite values are an Error that says where.

#include "core/image.h"

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

/// Which pixels count: 1 = kept. Row 0 is the top.
struct Mask {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> keep;

    Mask() = default;
    /// Keeps every pixel.
    Mask(int w, int h) : width(w), height(h), keep(size_t(w) * h, 1) {}
    size_t count() const;
    double share() const { return keep.empty() ? 0 : double(count()) / double(keep.size()); }
};

/// Keeps what both keep. Throws Error when the sizes differ.
Mask operator&(const Mask& a, const Mask& b);

/// Drops a pixel when any of its 3×3 neighbours has |n₁·(x₂ − x₁)| above 1 % of the view distance or n₁·n₂ < 0.9, or
/// when surface meets background in them. `normal` and `position` are world-space images of three channels taken at
/// pixel centres; a zero normal marks background, and background among background is kept.
Mask edge_mask(const Image& normal, const Image& position, const glm::vec3& camera_position);
/// Keeps pixels that show a surface (normal not zero).
Mask surface_mask(const Image& normal);
/// Keeps pixels whose first channel, rounded, is `value`: a material, an object, or a surface of `surface_ids`.
Mask component_mask(const Image& ids, int value);
/// "Per surface": 6·material + the dominant axis of the normal (+X −X +Y −Y +Z −Z), −1 for background.
Image surface_ids(const Image& material, const Image& normal);
/// The distinct values of the first channel of an id image with their pixel counts, most frequent first; negative ones
/// are left out.
std::vector<std::pair<int, size_t>> component_counts(const Image& ids);

struct ErrorFigures {
    size_t pixels = 0;         ///< unmasked
    double mean = 0;           ///< of a
    double reference_mean = 0; ///< of b
    double bias = 0; ///< (mean(a) − mean(b)) / |mean(b)|; 0 when both means are 0, infinite when only mean(b) is
    double rmse = 0; ///< √ mean (a − b)²
    double relative_rmse = 0; ///< rmse / |mean(b)|, as for bias when mean(b) is 0
    double relative_mse = 0;  ///< mean of (a − b)² / (b² + ε), ε = 0.01·mean(b)²: the usual 0.01, free of units
    double smape = 0;         ///< mean of |a − b| / (|a| + |b|), 0/0 = 0: from 0 to 1
    double relative_error_p99 =
        0; ///< 99th percentile over pixels of mean|a − b| / (mean|b| + 0.01·|mean(b)|), means over channels
    double largest_error = 0; ///< max |a − b|

    /// The share of `relative_rmse` that the reference's own noise explains: √ mean variance / |mean(b)|; 0 when not
    /// known.
    double reference_noise = 0;
    /// √max(0, rmse² − variance) / |mean(b)|: relative RMSE against a reference without noise, on average.
    double relative_rmse_denoised = 0;

    /// Absolute, in the images' own units: what counts for occlusion.
    double mean_difference() const { return mean - reference_mean; }
    double rmse_denoised() const { return relative_rmse_denoised * std::abs(reference_mean); }
};

/// Throws Error as said above. `reference_rms_noise` is the RMS standard error of the reference's values (in the units
/// of b) over the same pixels; 0 when not known.
ErrorFigures error_figures(const Image& test, const Image& reference, const Mask& mask, double reference_rms_noise = 0);
ErrorFigures error_figures(const Image& test, const Image& reference);

/// The mean over unmasked pixels and channels.
double image_mean(const Image& image, const Mask& mask);
/// √ mean ((a − b) / 2)² over unmasked pixels: the RMS standard error of the mean of two independent halves.
double half_image_noise(const Image& half_a, const Image& half_b, const Mask& mask);

/// SSIM (Wang, Bovik, Sheikh, Simoncelli 2004): 11×11 Gaussian window of σ 1.5 cut at the image's border, K₁ 0.01,
/// K₂ 0.03, range 1, on the luma of display-encoded values. The mean over unmasked pixels; 1 = equal. Both images are
/// linear RGB in display range (clamped to [0,1]).
double ssim(const Image& test, const Image& reference, const Mask& mask);

/// Throws an Error that names `what`, the pixel and the channel when a value is NaN or infinite.
void check_finite(const Image& image, const std::string& what);
/// Throws an Error that names both sizes when width, height or channels differ.
void check_same_size(const Image& a, const std::string& what_a, const Image& b, const std::string& what_b);

/// Linear radiance to linear display values in [0,1], for the metrics that are defined there (SSIM, FLIP): times
/// 2^exposure, then the filmic curve of Narkowicz's fit to ACES.
Image display_values(const Image& radiance, float exposure);
/// The exposure (stops) that brings the mean luminance of unmasked pixels to 0.18; 0 for a black image.
float automatic_exposure(const Image& reference, const Mask& mask);

} // namespace bounce
