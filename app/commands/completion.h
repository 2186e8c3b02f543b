#pragma once
// Completion scripts for shells, made from the command line itself.

#include <CLI/CLI.hpp>
#include <string>

namespace bounce {

/// The script for "bash" or "zsh". Subcommands and options are written into it; names come from `bounce list` when they
/// are wanted. Throws Error for other shells.
std::string completion_script(const CLI::App& app, const std::string& shell);

} // namespace bounce
