#pragma once
// The page of all methods in words that are computed from the points, with a table a scene.

#include "app/experiments/method_front.h"

namespace bounce {

/// Points of one scene that a group holds.
std::vector<const ChartPoint*> points_of(const std::vector<ChartPoint>& points, const MethodScene& scene,
                                         const MethodGroup& group);

/// "8.1 %", "0.0312 AO": the metric of a point against the reference of its own transport.
std::string error_text(const ChartPoint& point, const Metric& metric);

/// One paragraph about a group of methods on one scene: who is on the front and by what factor, what tuning buys, who
/// is beaten everywhere. Empty where there are no points.
std::string group_text(const MethodSuite& suite, const MethodGroup& group, const std::vector<const ChartPoint*>& points,
                       const Metric& metric);

/// Everything about one scene. `points` are the whole chart's.
std::string scene_text(const MethodSuite& suite, const MethodScene& scene, const std::vector<ChartPoint>& points,
                       const Metric& metric);

/// The whole page; `head` says where it comes from.
std::string methods_markdown(const MethodSuite& suite, const std::vector<ChartPoint>& points, const Metric& metric,
                             const std::string& head);

} // namespace bounce
