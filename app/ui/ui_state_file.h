#pragma once
// What the window remembers between runs, as JSON in the state folder. It is written as soon as a change is at rest,
// so that a process that is killed loses nothing.

#include "app/ui/window_state.h"

namespace bounce {

/// The state of the last run; defaults where there is none. A damaged file, or a damaged part of it, is ignored with
/// one line in the log.
WindowState load_window_state();
/// The file's text.
std::string window_state_text(const WindowState& state);
/// Writes aside and renames. A folder that cannot be written costs a line in the log, no more.
void save_window_state(const std::string& text);

} // namespace bounce
