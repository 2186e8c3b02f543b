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

/// "RMSE in AO units", "|bias| in %, same transport", "1 - SSIM, same transport": of the axis of errors.
std::string error_title(const Metric& metric, bool occlusion);
/// The value of the parameter "pass.name", or "name" of any pass; 0 when the point does not set it.
double parameter_of(const ChartPoint& point, const std::string& against);

/// Text made safe for XML and HTML.
std::string escape_markup(const std::string& text);

} // namespace bounce
