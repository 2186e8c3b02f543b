#pragma once
// Points of a chart as pages show them.

#include "app/experiments/page_data.h"
#include "app/experiments/svg_scatter.h"

namespace bounce {

/// Names, settings, numbers (by the keys of costs and errors) and figures; no pictures.
PagePoint page_point(const ChartPoint& point, const ChartView& view);
/// The errors that a page can draw: what a person reads, and the view's own.
std::vector<PageError> page_errors(const ChartView& view, bool occlusion);

} // namespace bounce
