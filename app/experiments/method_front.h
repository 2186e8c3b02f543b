#pragma once
// Who is on the front of a group of methods, and who is beaten everywhere: what the page of all methods says in words.

#include "app/experiments/method_suite.h"

#include <functional>

namespace bounce {

/// Time and error of a point, as a comparison wants them.
struct MethodScore {
    const ChartPoint* point = nullptr;
    double ms = 0, error = 0;
};

/// None where a point has no error by the metric.
using ScoreOf = std::function<std::optional<double>(const ChartPoint&)>;
std::vector<MethodScore> scores_of(const std::vector<const ChartPoint*>& points, const ScoreOf& error_of);

/// Those that no other beats in time or error, the fastest first.
std::vector<MethodScore> front_of(std::vector<MethodScore> scores);

/// A graph all of whose points are beaten: its most accurate one, and the fastest of another graph that is at least as
/// accurate.
struct BeatenMethod {
    MethodScore best, by;
};
/// Sorted by name.
std::vector<BeatenMethod> beaten_everywhere(const std::vector<MethodScore>& scores);

/// The most accurate point of each graph (of two alike the faster), by name.
std::map<std::string, MethodScore> best_of_graphs(const std::vector<MethodScore>& scores);

/// The most accurate point within `ms` of each graph that has one.
std::map<std::string, MethodScore> best_within(const std::vector<MethodScore>& scores, double ms);

} // namespace bounce
