#pragma once
// A chart's files: CSV, JSON, SVG, and one self-contained HTML page.

#include "app/experiments/svg_scatter.h"

#include <filesystem>

namespace bounce {

std::string chart_csv(const std::vector<ChartPoint>& points);
/// Points to zoom into, to choose and to compare; without script a chart and a table.
std::string chart_html(const std::vector<ChartPoint>& points, const ChartView& view = {});
/// "bias %", or of points in different units "bias".
std::string chart_heading(const Metric& metric);
/// A table of the points, for reading beside prose.
std::string chart_markdown(const std::vector<ChartPoint>& points);
/// Where the points come from: a paragraph of Markdown.
std::string head_of(const std::vector<ChartPoint>& points);
/// An SVG file that says where it comes from.
std::string with_head(const std::string& svg, const std::vector<ChartPoint>& points);
/// Errors in a few words: "bias +1.25 %, RMSE 12.30 %, …".
std::string error_summary(const MetricValues& values, bool occlusion);
/// Writes chart.csv, chart.json, chart.svg, chart.html and chart.md into `folder`. Throws Error.
void write_report(std::vector<ChartPoint> points, const std::filesystem::path& folder, const ChartView& view = {});

} // namespace bounce
