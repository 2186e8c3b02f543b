#pragma once
// How steady a part of the picture is from frame to frame while lights or objects of the shot move in small steps.

#include "app/session.h"

#include <string>
#include <vector>

namespace bounce {

/// Of luminance, relative to the mean over all frames and pixels where there is a surface. The second difference
/// L(i+1) − 2·L(i) + L(i−1) leaves out what changes evenly: a light that moves on gives next to none, flicker does.
struct FlickerFigures {
    int frames = 0;
    double mean = 0;        ///< luminance
    double change = 0;      ///< RMS of L(i+1) − L(i), over the mean
    double flicker = 0;     ///< RMS of the second difference, over the mean
    double flicker_p99 = 0; ///< 99th percentile of its magnitude, over the mean
};

/// Luminance of a 2D picture of the graph, as light is meant (without the pre-exposure). Throws Error when there is
/// none.
std::vector<float> luminance_of(Session& session, const std::string& resource);

/// Renders `frames` ≥ 3 frames of the session's shot. Throws Error when `resource` is no picture of the graph.
FlickerFigures measure_flicker(Session& session, const std::string& resource, int frames);

} // namespace bounce
