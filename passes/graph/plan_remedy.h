#pragma once
// What a person may lower when a plan does not fit.

#include "graph/model.h"

#include <functional>
#include <string>

namespace bounce {

/// What is to become smaller, of a plan of that model.
using PlanMeasure = std::function<double(GraphModel&, const Plan&)>;

/// "lower shadow_maps.resolution (2048): half of it would need 1.00 GiB": the change of one parameter, or of the size,
/// that makes least of `measure`. Whole numbers are halved; with `choices` switches are also turned and enumerations
/// set to their other values. Where none helps and fewer lights would, it says that. Empty when nothing makes less. The
/// model is left as it was, its shaders' text apart, which is to be scanned again.
std::string plan_remedy(GraphModel& model, const SceneFacts& facts, const Plan& plan, const PlanMeasure& measure,
                        const std::function<std::string(double)>& shown, bool choices = false);

} // namespace bounce
