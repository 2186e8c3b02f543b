#pragma once
// An exclusive prefix sum on the GPU, for passes that compact what they find into places that do not depend on the
// order of execution. A pass calls the three functions from its own describe, declare and execute; its slot
// `prefix.values` holds the numbers, and their prefix sum afterwards.

#include "graph/context.h"

namespace bounce {

/// `values`: the resource behind the slot prefix.values; beside it there is one of that name and "_sums".
void describe_prefix_sum(PassDescription& description, const std::string& values);
/// `count`: values, an expression (at most 2³¹ − 1); one more lies behind them, for the total.
void declare_prefix_sum(Declaration& declaration, const std::string& count);
/// values[i] ← values[0] + … + values[i − 1]; values[count] is the total. What wrote the values needs a barrier before,
/// as does what reads them after.
void run_prefix_sum(PassContext& context, int64_t count);

} // namespace bounce
