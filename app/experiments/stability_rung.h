#pragma once
// One rung of a stability case's ladder: its names with their values, and the scenes and shot that they make.

#include "app/experiments/stability_case.h"
#include "app/experiments/sweep.h"

#include <map>

namespace bounce {

/// The values of names.
using StabilityNames = std::map<std::string, double>;

/// The names of a rung; those of `against` replace them where that is asked for. Throws Error.
StabilityNames names_of_rung(const StabilityCase& which, double rung, bool against, int bounces);
/// Writes the rung's scenes and shot into `folder`; returns the shot, or the name of the case's own. Throws Error.
std::string write_rung(const StabilityCase& which, const StabilityNames& names, const std::filesystem::path& folder);
/// The parameters to set, of those that a graph has.
ParameterValues sets_of_rung(const StabilityCase& which, const StabilityNames& names,
                             const std::vector<std::string>& parameters);
/// The value of `expected`. Throws Error.
double expected_of(const StabilityCase& which, const StabilityNames& names);

} // namespace bounce
