#pragma once
// Pictures of all methods at about equal time: one SVG a scene, which holds its pictures, and a page with their
// figures.

#include "app/experiments/method_front.h"

#include <array>

namespace bounce {

/// Within which each method shows its most accurate point: milliseconds.
inline constexpr std::array<double, 2> k_gallery_classes = {100, 1000};

/// A row for each class of time and group of methods: the reference, then each graph's most accurate point within that
/// time, its picture over its false-colour error (0 … 50 %, black to white) and its figures. Empty where the scene has
/// no points.
std::string gallery_svg(const MethodSuite& suite, const MethodScene& scene, const std::vector<ChartPoint>& points,
                        const Metric& metric);

/// The file of a scene's pictures, without a folder.
std::string gallery_file(const MethodScene& scene);

std::string gallery_markdown(const MethodSuite& suite, const std::vector<ChartPoint>& points, const Metric& metric,
                             const std::string& head);

} // namespace bounce
