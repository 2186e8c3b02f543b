#pragma once
// Arithmetic in graph files: sizes, dispatches, needs, repeats ("width / 2", "lights && glossy_materials",
// "direct.visibility == cones").

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

/// Finds the value of a name, or nothing when there is no such name.
using NameLookup = std::function<std::optional<double>(const std::string&)>;

/// What the names of an expression stand for (see scope.h for those of graph files).
struct Names {
    NameLookup value;
    /// The choices of a name that stands for an enumeration; null for others. May be empty: there are none.
    std::function<const std::vector<std::string>*(const std::string&)> choices;
    /// Every name, so that an error names the nearest. May be empty.
    std::function<std::vector<std::string>()> known;

    template <typename Lookup>
    requires std::is_invocable_r_v < std::optional<double>, Lookup,
    const std::string& > Names(Lookup lookup) : value(std::move(lookup)) {}
};

/// Evaluates by muParser: + − * / ^, comparisons, && || !, ?:, min, max, abs, rint, sqrt, log2, exp, ceil, floor, true,
/// false. An enumeration is compared with its choices by name. Throws Error with the text, what is wrong and the
/// nearest name.
double evaluate(const std::string& expression, const Names& names);
/// The same, as a whole number ≥ `least`: rounded down.
int evaluate_integer(const std::string& expression, const Names& names, int least);

} // namespace bounce
