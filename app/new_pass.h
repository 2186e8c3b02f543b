#pragma once
// Writes a working pass to start from.

#include <string>

namespace bounce {

struct NewPass {
    std::string name;             ///< lower case letters, digits, underscores
    std::string graph = "direct"; ///< name or .json
    bool cpp = false;             ///< a C++ class too
};

/// Writes glsl/user/NAME.comp (and passes/user/NAME.cpp), and adds an entry to the graph file, whose comments and
/// layout stay. The pass changes out.radiance, so the picture shows it at once. Returns what was done and what to do
/// next. Throws Error for a bad or taken name; then nothing is written.
std::string write_new_pass(const NewPass& request);

} // namespace bounce
