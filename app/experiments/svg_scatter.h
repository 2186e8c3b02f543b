#pragma once
// A scatter of error against time as SVG, both axes logarithmic, with the Pareto front of each shot marked.

#include "app/experiments/chart_point.h"

#include <string>
#include <vector>

namespace bounce {

/// One plot a shot, side by side below each other. Points carry titles (shown on hover) with what made them. Errors of
/// occlusion are absolute. `against`: the error over a parameter ("pass.name", or "name" of any pass) instead of over
/// time.
std::string svg_scatter(const std::vector<ChartPoint>& points, const std::string& against = "");

/// Text made safe for XML and HTML.
std::string escape_markup(const std::string& text);

} // namespace bounce
