#pragma once
// What is wrong with a command line, in words that help to write it right.

#include <CLI/CLI.hpp>
#include <string>

namespace bounce {

/// One message for what CLI11 refused; `app` is as it is after the refused parse.
std::string usage_error(CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

} // namespace bounce
