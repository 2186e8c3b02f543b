#pragma once
// Separable convolution of single-channel images, for the image metrics.

#include "core/image.h"

#include <vector>

namespace bounce {

/// What a filter reads beyond the border: the nearest pixel, or nothing (the weights that fall inside are normalised).
enum class Border { nearest, cut };

/// Convolves with `across` along x and `down` along y; both have odd lengths, centre in the middle.
std::vector<float> convolve(const std::vector<float>& image, int width, int height, const std::vector<float>& across,
                            const std::vector<float>& down, Border border);

} // namespace bounce
