#pragma once
// The graph's own parameter that every graph has.

#include "core/parameters.h"

namespace bounce {

inline constexpr const char* k_rebuild = "rebuild";
ParameterInfo rebuild_parameter();

} // namespace bounce
