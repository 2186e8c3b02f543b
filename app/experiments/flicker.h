#pragma once
// How steady a part of the picture is from frame to frame while lights or objects of the shot move in small steps.

#include "app/session.h"
#include "core/image.h"

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
    /// FLIP over time: the mean FLIP of each frame to the mean of the two beside it, as displays show them.
    double flip = 0;
};

/// Sums up the changes of luminance from frame to frame, frames of one size.
class SecondDifference {
  public:
    void add(std::vector<float> luminance);
    int frames() const { return frames_; }
    double mean() const { return count_ > 0 ? sum_ / double(count_) : 0; }
    double change() const;      ///< RMS of L(i+1) − L(i), over the mean
    double flicker() const;     ///< RMS of the second difference, over the mean; 0 below three frames
    double flicker_p99() const; ///< 99th percentile of its magnitude, over the mean

  private:
    std::vector<float> before_, last_, magnitudes_;
    double sum_ = 0, first_squares_ = 0, second_squares_ = 0;
    size_t count_ = 0, firsts_ = 0;
    int frames_ = 0;
};

std::vector<float> luminance_of(const Image& image);

/// Luminance of a 2D picture of the graph, as light is meant (without the pre-exposure). Throws Error when there is
/// none.
std::vector<float> luminance_of(Session& session, const std::string& resource);

/// Renders `frames` ≥ 3 frames of the session's shot. Throws Error when `resource` is no picture of the graph.
FlickerFigures measure_flicker(Session& session, const std::string& resource, int frames);

} // namespace bounce
