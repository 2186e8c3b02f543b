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
    /// Shares of the pixels that lie outside of the files' data windows, where they count as black.
    double image_outside = 0, reference_outside = 0;
};

/// A table with a column for each metric that a person reads, and what it is measured over.
std::string comparison_text(const ComparisonReport& report);
/// Every metric of every part by name.
std::string comparison_json(const ComparisonReport& report);

} // namespace bounce
