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

/// The shot (.json) or scene (.gltf, .glb) that a person names: a path, a shot of the assets, or a scene by name.
/// Throws Error that tells the nearest names.
std::filesystem::path find_shot(const std::string& name);

/// As find_scene in shot.h, for a name that a person gives: an absolute path may be given, too.
std::filesystem::path find_given_scene(const std::string& name);

/// Any other file (an .hdr map) that a file names: relative to `base`, then along the search path. Throws Error naming
/// the places tried, and for an absolute path, a URL or what is no regular file.
std::filesystem::path find_scene_file(const std::string& name, const std::filesystem::path& base);

} // namespace bounce
