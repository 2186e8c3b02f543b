#pragma once
// A chart's files: CSV, JSON, SVG, and one self-contained HTML page.

#include "app/experiments/chart_point.h"

#include <filesystem>

namespace bounce {

std::string chart_csv(const std::vector<ChartPoint>& points);
std::string chart_html(const std::vector<ChartPoint>& points, const std::string& against = "");
/// Writes chart.csv, chart.json, chart.svg and chart.html into `folder`. Throws Error. `against`: see
/// svg_scatter.
void write_report(std::vector<ChartPoint> points, const std::filesystem::path& folder, const std::string& against = "");

} // namespace bounce
