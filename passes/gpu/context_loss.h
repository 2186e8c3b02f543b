#pragma once
// Whether the context has been lost: a shader that ran for too long, another program's, or the driver's own trouble
// made the GPU reset, and all that was on it is gone.

#include "core/error.h"

#include <string>

namespace bounce {

/// Whose work the driver resets the GPU for (OpenGL 4.6, §2.3.2).
enum class ResetCause { none, guilty, innocent, unknown };
/// "the GPU was reset because of what this program did"
const char* to_string(ResetCause cause);

/// Asks the driver. A reset that was told once is remembered until another context has become current: drivers need
/// not tell it twice. Always none where the context is not a robust one.
ResetCause context_reset();
inline bool context_is_lost() {
    return context_reset() != ResetCause::none;
}

/// For tests and --simulate-reset: from here on the context counts as lost.
void pretend_reset(ResetCause cause);
/// Another context has become current.
void forget_reset();

/// What was to be rendered is void, since the GPU was reset meanwhile.
class ContextLost : public Error {
  public:
    using Error::Error;
};

} // namespace bounce
