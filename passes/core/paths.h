#pragma once
// Where the program's own files are. An installed or moved binary finds them.

#include <filesystem>

namespace bounce {

/// The folder that holds `glsl/` and `assets/`: $BOUNCE_ROOT when set; else beside the executable (or share/bounce
/// beside its folder); else the source tree it was built from. Throws Error naming the places tried.
std::filesystem::path root_folder();
inline std::filesystem::path glsl_folder() {
    return root_folder() / "glsl";
}
inline std::filesystem::path assets_folder() {
    return root_folder() / "assets";
}

/// $XDG_CACHE_HOME/bounce or ~/.cache/bounce; and the state folder for the window's layout and bookmarks
/// ($XDG_STATE_HOME/bounce or ~/.local/state/bounce). Created when absent.
std::filesystem::path cache_folder();
std::filesystem::path state_folder();

} // namespace bounce
