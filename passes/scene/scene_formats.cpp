#include "scene/scene_formats.h"

#include "core/error.h"
#include "core/text.h"
#include "scene/shot.h"

#include <algorithm>
#include <cctype>

namespace bounce {

const std::vector<SceneFormat>& scene_formats() {
    static const std::vector<SceneFormat> formats = {{"glTF 2.0", {".gltf", ".glb"}, load_gltf}};
    return formats;
}

const SceneFormat* scene_format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = char(std::tolower(static_cast<unsigned char>(c)));
    for (const SceneFormat& format : scene_formats())
        if (std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end())
            return &format;
    return nullptr;
}

Scene load_scene(const std::filesystem::path& path) {
    const SceneFormat* format = scene_format_of(path);
    if (!format) throw Error(path.string() + ": not a scene: expected a file that ends in " + scene_extensions());
    return format->load(path);
}

std::string scene_extensions() {
    std::vector<std::string> all;
    for (const SceneFormat& format : scene_formats())
        all.insert(all.end(), format.extensions.begin(), format.extensions.end());
    return join(all, ", ");
}

} // namespace bounce
