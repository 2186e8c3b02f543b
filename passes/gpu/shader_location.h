#pragma once
// Where in which file a line of expanded shader text comes from.

#include "gpu/shader_source.h"

namespace bounce {

/// `file` relative to the glsl folder where it lies in it.
std::filesystem::path shown(const std::filesystem::path& file, const std::filesystem::path& folder);
/// An error at a line of the flat text (1-based), told with its file, line and source line; with the stage's file alone
/// where that line is none of a file.
ShaderError located_error(const ShaderSource& source, const std::filesystem::path& folder, size_t flat_line,
                          const std::string& message);

} // namespace bounce
