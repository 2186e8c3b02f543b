#pragma once
// False colour for error maps.

#include "core/image.h"
#include "core/metrics.h"

#include <glm/glm.hpp>

namespace bounce {

/// The perceptually uniform colour map "magma" (van der Walt & Smith, matplotlib): t in [0,1] (clamped; NaN as 0) →
/// sRGB-encoded in [0,1]. Lightness grows steadily from black to a pale yellow.
glm::vec3 magma(float t);

/// `values` (one channel) as false colour: `low` is black, `high` the brightest; equal bounds are an Error. Pixels that
/// the mask drops are a flat mid grey; NaN and infinite values are pure green, which magma does not contain.
Image8 heat_map(const Image& values, float low, float high, const Mask& mask);
Image8 heat_map(const Image& values, float low, float high);

/// Per pixel |a − b| averaged over channels, divided by the reference's mean over all pixels: what `heat_map` usually
/// shows.
Image relative_error_map(const Image& test, const Image& reference);

} // namespace bounce
