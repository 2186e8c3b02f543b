#pragma once
// Numbers that take some values alone: the widths of a grid, the sides of a map. Their ParameterInfo::choices are these
// values as text, rising, and `min` and `max` the ends.

#include "core/parameters.h"

namespace bounce {

/// Whether each of these is a number: then they are the values of a parameter, and no names.
bool are_numbers(const std::vector<std::string>& choices);

/// `info`, an integer or a real, takes these values alone. Throws Error when one is no value of that kind.
void choose_from(ParameterInfo& info, const std::vector<std::string>& values);

/// An integer of a pass's set takes the powers of two within its range alone.
void choose_powers_of_two(ParameterSet& set, std::string_view name);

/// The values next to this one, below and above; fewer at the ends. Empty for what has no steps.
std::vector<ParameterValue> steps_beside(const ParameterInfo& info, const ParameterValue& value);

} // namespace bounce
