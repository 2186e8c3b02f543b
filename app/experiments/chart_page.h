#pragma once
// Points as the script assets/pages/chart.js reads them.

#include "app/experiments/svg_scatter.h"

#include <nlohmann/json_fwd.hpp>

namespace bounce {

/// Names, settings, numbers (by the keys of costs and errors) and figures as text; no pictures.
nlohmann::ordered_json page_point(const ChartPoint& point, const ChartView& view);
/// The errors that a page can draw (what a person reads, and the view's own): key, title, whether it is a share.
nlohmann::ordered_json page_errors(const ChartView& view, bool occlusion);

} // namespace bounce
