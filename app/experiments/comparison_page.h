#pragma once
// A comparison of two pictures as a page: both under a divider, the error map, every part's figures.

#include "app/experiments/comparison_text.h"

namespace bounce {

/// What the page shows of one part, prepared by the caller: of one size and channel count.
struct ComparedPictures {
    std::string part; ///< "" for a plain picture
    Image image, reference;
    bool light = true; ///< radiance; else values that are shown as they are
    float exposure = 0;
    float top = 0.5f; ///< the error (of the reference's mean) that is brightest in the map
};

/// Pictures wider than this are shown as means over areas.
inline constexpr int k_compared_width = 1920;

std::string comparison_html(const ComparisonReport& report, const ComparedPictures& pictures);

} // namespace bounce
