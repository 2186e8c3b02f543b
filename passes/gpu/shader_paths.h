#pragma once
// Where shaders are read from: what a graph file or an #include names stays below the folder of shaders.

#include <filesystem>

namespace bounce {

/// Throws Error unless `file` lies below `folder` (glsl/), by its name and where links lead; the user's own shaders,
/// `folder`/user, may be a link to a folder elsewhere.
void check_shader_path(const std::filesystem::path& file, const std::filesystem::path& folder);

} // namespace bounce
