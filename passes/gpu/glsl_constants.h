#pragma once
// Constant expressions of GLSL: array sizes, loop bounds, #if.

#include "gpu/glsl_tokens.h"

#include <functional>
#include <optional>
#include <span>

namespace bounce {

/// The value of a constant expression as a number (integers exactly up to 2^53; larger ones are large); nullopt when it
/// is none, or uses what `named` does not know. Whole numbers divide as such.
std::optional<double> constant_value(std::span<const GlslToken> tokens,
                                     const std::function<std::optional<double>(std::string_view)>& named);

} // namespace bounce
