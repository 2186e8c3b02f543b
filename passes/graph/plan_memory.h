#pragma once
// Whether a plan fits, asked before anything is allocated.

#include "graph/model.h"

namespace bounce {

/// Throws Error when the plan goes beyond a limit of the driver (plan_needs.h), or when its resources need more main
/// memory than there is, `held` bytes of which this graph has already. Where they need more than is free on a GPU, it
/// warns. The message has the numbers and names what to lower. Wants a current context.
void check_plan_fits(GraphModel& model, const SceneFacts& facts, const Plan& plan, uint64_t held);

/// What to tell when the driver had no memory for it after all; `what` it could not allocate.
std::string out_of_memory_text(GraphModel& model, const SceneFacts& facts, const Plan& plan, const std::string& what);

} // namespace bounce
