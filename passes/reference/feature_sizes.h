#pragma once
// How fine the scene is where it is seen, and how unevenly the light that it reflects is spread: by rays from what a
// camera sees. A few ten thousand rays; the same numbers in every run.

#include "scene/shot.h"

namespace bounce {

struct FeatureSizes {
    size_t points = 0; ///< of surfaces that are seen
    /// How far the surfaces around lie: of each point the median over directions (by cosine), metres. A tenth and a
    /// half of the points are below.
    float gap_10 = 0, gap_50 = 0;
    float area = 0; ///< of all triangles, m²
    /// Which share of the directions (by cosine) meets a surface that a light shines on directly.
    float lit_share = 0;
    /// Variance over squared mean of what one ray (by cosine) brings, the mean over the points by their light.
    float ray_variance = 0;
};

/// Of the shot's first frame: its camera, and where it has a path, the path's keys. Surfaces count from both sides;
/// alpha-tested ones from alpha ½ on.
FeatureSizes measure_features(const Shot& shot);

} // namespace bounce
