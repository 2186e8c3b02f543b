#pragma once
// FLIP, the difference that a viewer sees when two images are flipped between (Andersson, Nilsson, Akenine-Möller,
// Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for Alternating Images, HPG 2020), for low dynamic range
// images.

#include "core/image.h"
#include "core/metrics.h"

namespace bounce {

/// Pixels per degree of visual angle on a display: distance and width in metres.
float pixels_per_degree(float distance, float display_width, int display_pixels);
/// The paper's setup: a 0.7 m wide display of 3840 pixels seen from 0.7 m, 67.02 pixels a degree.
constexpr float k_flip_pixels_per_degree = 67.0206433f;

/// The FLIP value in [0, 1] of each pixel (one channel; 0 = no visible difference). Both images are linear RGB in
/// display range: values are clamped to [0,1] (tone-map radiance first, `display_values`). Throws Error on different
/// sizes, fewer than three channels, NaN.
Image flip(const Image& test, const Image& reference, float ppd = k_flip_pixels_per_degree);
/// The mean of the map over unmasked pixels, FLIP's usual summary.
double flip_mean(const Image& map, const Mask& mask);

} // namespace bounce
