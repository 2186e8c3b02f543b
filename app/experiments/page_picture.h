#pragma once
// Pictures as pages show them: at most so many pixels wide, as means over the pixels' areas.

#include "core/image.h"
#include "core/metrics.h"

#include <string>

namespace bounce {

/// Of the pictures of a chart's point: what is larger makes the page large.
inline constexpr int k_point_picture_width = 320;

/// What an eye would see of a picture, as a PNG in base64. `light`: radiance, through the tone curve at `exposure`
/// stops; else the values as they are (occlusion, display values), clamped to [0, 1].
std::string page_picture(const Image& linear, bool light, float exposure, int max_width);

/// False colour of errors from 0 to `top`, likewise. Pixels that the mask drops do not count.
std::string page_error_map(const Image& errors, float top, const Mask& mask, int max_width);

} // namespace bounce
