#pragma once
// Coverage by chance: a surface of alpha α is there where α reaches a threshold that is drawn evenly from (0, 1], so
// that it is there with the probability α, always at 1 and never at 0. glsl/lib/coverage.glsl mirrors this file.

#include <algorithm>
#include <cstdint>

namespace bounce {

/// From 32 well mixed bits. A little short of 1, for alphas that interpolation leaves a rounding step below 1.
inline float coverage_threshold(uint32_t bits) {
    return std::min(float((bits >> 8) + 1) * 0x1p-24f, 0.999999f);
}

/// Of a masked material: a little short of its cutoff, likewise.
inline float mask_threshold(float cutoff) {
    return cutoff - 1e-6f;
}

} // namespace bounce
