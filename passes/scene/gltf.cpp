#include "core/error.h"
#include "scene/gltf_parts.h"
#include "scene/loaded_space.h"
#include "scene/shot.h"

#include <new>

namespace bounce {

Scene load_gltf(const std::filesystem::path& path) {
    try {
        GltfSource source = open_gltf(path);
        Scene scene;
        scene.name = path.stem().string();
        scene.notes = source.notes;
        read_materials(source, scene);
        read_meshes(source, scene);
        std::vector<int> node_index = read_nodes(source, scene);
        read_animations(source, node_index, scene);
        recentre_meshes(scene);
        mark_dynamic_nodes(scene);
        return scene;
    } catch (const std::bad_alloc&) {
        throw Error(path.string() + ": not enough memory to load it");
    }
}

} // namespace bounce
