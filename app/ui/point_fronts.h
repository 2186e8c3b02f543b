#pragma once
// The points of the Compare panel that no other of their light transport beats in both time and error.

#include "app/ui/live_comparison.h"

#include <functional>
#include <map>

namespace bounce {

/// By transport: indices into `points`, by rising time. Points without a time or a finite error above 0 are left out.
std::map<std::string, std::vector<size_t>> pareto_fronts(const std::vector<ComparePoint>& points,
                                                         const std::function<double(const ComparePoint&)>& error_of);

} // namespace bounce
