#pragma once

#include "app/session.h"

#include <string>

namespace bounce {

/// Throws Error "`where`: …" with every problem of a session's graph and shaders, each once; does nothing when there is
/// none.
void throw_if_broken(const Session& session, const std::string& where);

} // namespace bounce
