#pragma once
// A comparison as a person reads it and as a program does.

#include "core/comparison.h"

#include <string>
#include <vector>

namespace bounce {

struct ComparisonReport {
    std::string image, reference; ///< as they were named
    LayerComparison comparison;
    std::vector<SurfaceComparison> surfaces;
    int pixels_a_side = 1; ///< of the image for each of the reference
    int window = 1;        ///< of PartComparison::windowed
    /// The shares of both pictures for which their files hold no data (PicturePlace::outside).
    double outside = 0, reference_outside = 0;
};

/// A table with a column for each metric that a person reads, and what it is measured over.
std::string comparison_text(const ComparisonReport& report);
/// What it is measured over, a sentence each.
std::vector<std::string> comparison_notes(const ComparisonReport& report);
/// Every metric of every part by name.
std::string comparison_json(const ComparisonReport& report);

} // namespace bounce
