#pragma once
// The smaller levels of a texture. Made here and not by the driver: some drivers average sRGB codes, or round down at
// each level, which darkens what is far away.

#include "core/image.h"

#include <vector>

namespace bounce {

/// Levels 1, 2, … down to one texel, each half the size of the one before (rounded down, at least 1): every texel is
/// the mean of the area of level 0 that it covers, over decoded values where `srgb` is set (alpha never is), rounded
/// once.
std::vector<Image8> mip_chain(const Image8& image, bool srgb);

/// Scales each level's alpha so that as large a share of its texels reaches `cutoff` (0 … 1) as of level 0's: means of
/// alpha alone would let masked leaves vanish in the distance.
void keep_coverage(const Image8& whole, std::vector<Image8>& levels, float cutoff);

} // namespace bounce
