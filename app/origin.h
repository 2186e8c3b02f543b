#pragma once
// Where a result comes from: what stands at the head of every table and chart that a command writes.

#include <string>
#include <vector>

namespace bounce {

struct Origin {
    std::string commit;   ///< of the program
    std::string machine;  ///< "16 × AMD EPYC 7402P"
    std::string renderer; ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;   ///< "4.6 (Core Profile) Mesa 22.3.6"
    std::string date;     ///< UTC, "2026-01-31T12:00:00Z"; $SOURCE_DATE_EPOCH where that is set
};

/// Of this program, machine and time; with an OpenGL context current, of its driver too.
Origin origin_here();

/// What the program was called with, for origin_head: "bounce table lrsm". Set once, by main.
void set_command_line(int argc, const char* const* argv);
const std::string& command_line();

/// A paragraph of Markdown for the head of a result that `command` wrote, measured in one place or several.
std::string origin_head(const std::vector<Origin>& origins, const std::string& command = command_line());

} // namespace bounce
