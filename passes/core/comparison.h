#pragma once
// Two files of named parts, compared part by part by every metric of the table: the one comparison that `bounce
// compare`, charts, cost tables and the Compare panel show.

#include "core/metric_table.h"

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
    bool display_values = false;  ///< the pictures are linear display values already (8-bit files): no tone curve
    bool shown = true;            ///< compute what needs display values too (SSIM, FLIP), the slow ones
    bool absent_is_black = false; ///< a part that the test lacks is black: its graph had nothing to make it from
    int window = 1; ///< above 1: also after means over windows of so many pixels a side (odd), see window_mean
};

struct PartComparison {
    std::string part;
    MetricValues figures;
    MetricValues
        windowed; ///< after the means over windows; without the metrics of display values. Empty: not asked for
    float exposure = 0;
};

struct SurfaceComparison {
    int material = -1;
    std::string axis; ///< "+x" … "-z", the dominant axis of the normal
    std::string part;
    MetricValues figures; ///< without those of display values
};

struct LayerComparison {
    Mask mask;
    bool edges_masked = false;
    std::vector<PartComparison> parts;
};

/// `test` against `reference`. Throws Error when nothing can be paired, sizes differ, a value is not finite or the
/// window is even.
LayerComparison compare_layers(const LayeredImage& test, const LayeredImage& reference,
                               const ComparisonOptions& options);

/// "Per surface": each glTF material and dominant normal axis of at least 0.5 % of the mask's pixels, the largest
/// first. Needs gbuffer.material and gbuffer.normal in one of the files: else empty.
std::vector<SurfaceComparison> compare_surfaces(const LayeredImage& test, const LayeredImage& reference,
                                                const std::string& part, const Mask& mask);

/// The layer, or sum of layers, that `part` names; "" is the picture as a whole. Throws Error naming `what` when there
/// is none.
Image part_of(const LayeredImage& image, const std::string& part, const std::string& what);
/// The same; where there is none, black, as large as `like`: the graph had nothing to make it from.
Image part_or_black(const LayeredImage& image, const std::string& part, const Image& like);

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
