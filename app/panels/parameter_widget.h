#pragma once
// One widget that suits a parameter's kind and range.

#include "core/parameters.h"

namespace bounce {

/// Draws it at the width that is there; changes `value` and returns true when a person did. `at_once`: the kind has no
/// drag, a change is final. `name` is the parameter's full one ("direct.shadows").
bool draw_parameter_widget(const std::string& name, const ParameterInfo& info, ParameterValue& value, bool& at_once);

/// Equal drags mean equal ratios: the range is positive and spans more than three decades.
bool has_logarithmic_slider(const ParameterInfo& info);

} // namespace bounce
