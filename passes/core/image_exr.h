#pragma once
// OpenEXR files as other programs write them: one or several parts, scan lines or tiles, half, float or uint channels,
// mip levels (the full one is read), subsampled channels, any data and display window. Deep images are refused.

#include "core/image.h"

namespace bounce {

/// The attribute of our files that names the layer whose channels are stored under plain names (see exr_file.h).
constexpr const char* k_exr_default_layer = "bounceDefaultLayer";

/// A picture in the coordinates of its display window. What lies in the display window but outside of a part's data
/// window is part of the picture, and black (0); what lies outside of the display window is not part of it.
struct ExrPicture {
    /// By the names in front of the last dot of the channels. In files of several parts, channels without such a name
    /// belong to a layer named as their part.
    LayeredImage image;
    int x = 0, y = 0;   ///< the upper left pixel of the display window
    double outside = 0; ///< the share of its pixels that lie outside of a data window, the largest of all layers
};

enum class ExrChannels {
    all,     ///< R, G, B, A, X, Y, Z first, others in the order of their names
    radiance ///< R, G, B of a layer that has any of them; Y of another that has neither X nor Z (with those it is a
             ///< coordinate). No other channel, and no layer without these.
};

/// Throws Error that names the file: missing, damaged, no OpenEXR file, deep, or larger than memory should be.
ExrPicture read_exr_picture(const std::filesystem::path& path, ExrChannels channels);

} // namespace bounce
