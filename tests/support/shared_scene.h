#pragma once
// Test scenes that are no part of the project: they lie beside the source tree, or are absent.

#include <filesystem>
#include <string>

namespace bounce {

/// The place of `name` in the test scenes beside the source tree, or an empty path when they are not there.
inline std::filesystem::path shared_scene(const std::string& name) {
    std::filesystem::path path = std::filesystem::path(BOUNCE_TESTS_DIR) / ".." / ".." / "shared" / "scenes" / name;
    return std::filesystem::exists(path) ? path : std::filesystem::path();
}

} // namespace bounce
