#pragma once
// Where scenes and what belongs to them are looked for by name. See find_scene in shot.h for scenes themselves.

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

/// $BOUNCE_SCENES (colon separated), the assets' scenes folder, ../shared/scenes beside the program's root.
std::vector<std::filesystem::path> scene_search_path();

/// What may be written for a scene: the files and folders of the search path that hold one, sorted.
std::vector<std::string> scene_names();

/// Any other file (an .hdr map): relative to `base`, then along the search path. Throws Error naming the places tried.
std::filesystem::path find_scene_file(const std::string& name, const std::filesystem::path& base);

} // namespace bounce
