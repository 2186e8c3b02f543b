#pragma once
// Arithmetic in graph files: sizes, counts, repeats ("width / 2", "4 * voxel.resolution", "gbuffer.normal.width").

#include <functional>
#include <optional>
#include <string>

namespace bounce {

/// Finds the value of a name, or nothing when there is no such name.
using NameLookup = std::function<std::optional<double>(const std::string&)>;

/// Evaluates by muParser: + − * / ^, comparisons, ?:, min, max, abs, rint, sqrt, log2, exp, and ceil, floor.
/// Throws Error with the text and what is wrong (unknown names with the nearest when `known` lists them).
double evaluate(const std::string& expression, const NameLookup& lookup);
/// The same, as a whole number ≥ `least`: rounded down.
int evaluate_integer(const std::string& expression, const NameLookup& lookup, int least);

} // namespace bounce
