#pragma once
// Whether a plan fits, asked before anything is allocated.

#include "graph/model.h"

namespace bounce {

/// Throws Error when a texture of the plan is larger than this driver allows, or when the plan's resources need more
/// memory than there is, `held` bytes of which this graph has already. The message has the numbers and names what to
/// lower. Wants a current context.
void check_plan_fits(GraphModel& model, const SceneFacts& facts, const Plan& plan, uint64_t held);

} // namespace bounce
