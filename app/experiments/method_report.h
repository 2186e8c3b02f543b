#pragma once
// What a chart of all methods writes beside the chart itself: words, figures, charts, an interactive page and a
// gallery.

#include "app/experiments/method_suite.h"
#include "app/experiments/svg_scatter.h"

#include <filesystem>

namespace bounce {

/// The interactive page. Throws Error.
std::string methods_page(const MethodSuite& suite, const std::vector<ChartPoint>& points, const std::string& head);

/// Writes methods.md, methods.csv, methods.html, methods/*.svg (a group of methods each), gallery.md and gallery/*.svg
/// (a scene each). Throws Error.
void write_method_report(const MethodSuite& suite, std::vector<ChartPoint> points, const std::filesystem::path& folder,
                         const ChartView& view);

} // namespace bounce
