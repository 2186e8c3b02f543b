#pragma once
// Pictures averaged over small windows inside a mask: what is left of an error when its finest scale does not count
// (texture and normal maps within a pixel, noise, dither).

#include "core/metrics.h"

namespace bounce {

/// Each kept pixel becomes the mean of the kept pixels of the n × n window around it (n odd), cut at the border; what
/// the mask drops enters no mean and stays as it is. Throws Error when n is even or below 1.
Image window_mean(const Image& image, const Mask& mask, int n);

/// By how much the RMS of independent noise, even over the picture, falls: √ mean 1/k with k kept pixels in a window.
double window_noise_factor(const Mask& mask, int n);

} // namespace bounce
