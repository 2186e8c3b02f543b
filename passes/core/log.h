#pragma once
// The log: spdlog to stderr, plus a bounded history that the window's log panel reads.

#include <deque>
#include <spdlog/spdlog.h>
#include <string>

namespace bounce {

struct LogLine {
    spdlog::level::level_enum level;
    std::string text;
};

/// Sets up the default logger (stderr, "[warning] text"). Call once at start; `verbose` shows debug lines.
void start_log(bool verbose);
/// A copy of the last few hundred lines, oldest first. Thread safe.
std::deque<LogLine> recent_log_lines();

} // namespace bounce
