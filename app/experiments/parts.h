#pragma once
// Parts of a picture (out.*), summed.

#include "core/image.h"

#include <string>
#include <vector>

namespace bounce {

/// The sum of layers; parts that a graph does not make here (a declined pass) count as 0. Throws Error when none is
/// there.
Image sum_of_parts(const LayeredImage& image, const std::vector<std::string>& parts);
/// The relative noise that a reference's metadata states for these parts, added in squares; 0 when it states none.
double noise_of_parts(const LayeredImage& reference, const std::vector<std::string>& parts);

} // namespace bounce
