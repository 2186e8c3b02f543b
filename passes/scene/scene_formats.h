#pragma once
// The file formats that scenes are read from. A new format is one row here and its loader.

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

struct SceneFormat {
    std::string name;                    ///< "glTF 2.0"
    std::vector<std::string> extensions; ///< ".gltf", lower case
    Scene (*load)(const std::filesystem::path& path);
};

const std::vector<SceneFormat>& scene_formats();

/// By its extension, in any case; null when no format has it.
const SceneFormat* scene_format_of(const std::filesystem::path& path);

/// Throws Error: the format's own, or that none has this extension. What it skips is in Scene::notes.
Scene load_scene(const std::filesystem::path& path);

/// ".gltf, .glb", for messages and lists of what may be opened.
std::string scene_extensions();

} // namespace bounce
