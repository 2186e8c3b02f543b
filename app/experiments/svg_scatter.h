#pragma once
// A scatter of error against time as SVG, both axes logarithmic, with the Pareto front of each shot and
// light transport marked.

#include "app/experiments/chart_point.h"

#include <string>
#include <vector>

namespace bounce {

/// How a chart is drawn.
struct ChartView {
    std::string against; ///< errors over this parameter ("pass.name", or "name" of any pass) instead of over time
    std::string metric = k_default_error; ///< by which errors are drawn and Pareto fronts are found
};

/// One plot a shot, below each other. Points carry titles (shown on hover) with what made them. Errors of occlusion are
/// absolute.
std::string svg_scatter(const std::vector<ChartPoint>& points, const ChartView& view = {});

/// Text made safe for XML and HTML.
std::string escape_markup(const std::string& text);

} // namespace bounce
