#pragma once
// A stable sort of pairs (key, value) by their keys on the GPU; the result does not depend on the order of execution. A
// pass calls the three functions from its own describe, declare and execute, beside those of graph/prefix_sum.h, whose
// values the sort overwrites. Its slot `sort.pairs` holds two halves of as many pairs (8 bytes each).

#include "graph/context.h"

namespace bounce {

/// `pairs`: the resource behind the slot sort.pairs.
void describe_radix_sort(PassDescription& description, const std::string& pairs);
/// `count`: pairs in a half, an expression (at most 2³⁰).
void declare_radix_sort(Declaration& declaration, const std::string& count);
/// How many values the sort takes of prefix.values, for declare_prefix_sum; an expression of `count`.
std::string radix_sort_values(const std::string& count);
/// Sorts the `count` pairs of the first half by the lowest `bits` of their keys. Returns the half that then holds them.
int run_radix_sort(PassContext& context, int64_t count, int bits);

} // namespace bounce
