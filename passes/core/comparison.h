#pragma once
// Two files of named parts, compared part by part: what `bounce compare`, charts and the Compare panel show.

#include "core/flip.h"
#include "core/metrics.h"

#include <optional>
#include <string>
#include <vector>

namespace bounce {

struct ComparisonOptions {
    /// Parts by name; "a+b" compares the sums of layers (of which each file must hold at least one). Empty: every out.*
    /// layer that both files have, and the plain picture "" when there are no others; else what each file
    /// calls the picture as a whole (no name, ViewLayer.Combined, beauty …).
    std::vector<std::string> parts;
    bool mask_edges =
        true; ///< by gbuffer.normal and gbuffer.position of the reference, or else of the image, where one has them
    std::optional<float> exposure; ///< stops, for SSIM and FLIP of radiance; else automatic from the reference
    float ppd = k_flip_pixels_per_degree;
    bool display_values = false; ///< the pictures are linear display values already (8-bit files): no tone curve
    bool visual = true;          ///< compute SSIM and FLIP, the slow ones
};

struct PartComparison {
    std::string part;
    ErrorFigures figures;
    double ssim = 0, flip = 0;
    float exposure = 0;
    /// As figures.reference_noise, but of the compared image, when it says so of itself.
    double own_noise = 0;
};

struct SurfaceComparison {
    int material = -1;
    std::string axis; ///< "+x" … "-z", the dominant axis of the normal
    std::string part;
    ErrorFigures figures;
};

struct LayerComparison {
    Mask mask;
    bool edges_masked = false;
    std::vector<PartComparison> parts;
};

/// `test` against `reference`. Throws Error when nothing can be paired, sizes differ or a value is not finite.
LayerComparison compare_layers(const LayeredImage& test, const LayeredImage& reference,
                               const ComparisonOptions& options);

/// "Per surface": each glTF material and dominant normal axis of at least 0.5 % of the mask's pixels, the largest
/// first. Needs gbuffer.material and gbuffer.normal in one of the files: else empty.
std::vector<SurfaceComparison> compare_surfaces(const LayeredImage& test, const LayeredImage& reference,
                                                const std::string& part, const Mask& mask);

/// The layer, or sum of layers, that `part` names; "" is the picture as a whole. Throws Error naming `what` when there
/// is none.
Image part_of(const LayeredImage& image, const std::string& part, const std::string& what);

/// Whether a part is light, to be tone-mapped before it is looked at; occlusion and display values are not.
bool is_radiance(const std::string& part);

/// Makes the two comparable: a fourth channel is alpha, which is no radiance; against a picture of luminance alone, RGB
/// counts by its own luminance (Rec. 709).
void match_channels(Image& a, Image& b);

/// A picture of k times the reference's width and height (k a whole number above 1), as means over k × k pixels: of the
/// area that the reference's pixels cover, like they themselves. What is no light (gbuffer.*) is taken from the pixel
/// at the middle. Any other picture stays as it is. `k`, if given, becomes that number.
LayeredImage averaged_to_size_of(const LayeredImage& reference, LayeredImage image, int* k = nullptr);

/// Where a picture lies, as OpenEXR files say.
struct PicturePlace {
    int x = 0, y = 0;   ///< its upper left pixel
    double outside = 0; ///< the share of its pixels for which the file holds no data: they are black
};

/// Reads a picture to compare: the radiance of an .exr (R, G, B or Y of each layer, nothing else) over its display
/// window; any 8-bit format as the linear values of its sRGB (layer ""); .hdr. `display` tells whether the values are
/// display values.
LayeredImage read_picture(const std::filesystem::path& path, bool& display, PicturePlace* place = nullptr);

} // namespace bounce
