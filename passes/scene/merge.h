#pragma once
// Scenes placed in a scene.

#include "scene/scene.h"

#include <filesystem>
#include <map>

namespace bounce {

/// Adds other scenes' content to one scene. The geometry and pictures of a file placed several times are added once.
class SceneMerger {
  public:
    explicit SceneMerger(Scene& into) : into_(into) {}

    /// Adds the nodes of the glTF file below `root`, which becomes their parent; cameras of the file are dropped.
    /// Returns the index of that parent. Throws Error as load_gltf does, and when the whole grows beyond what 32-bit
    /// indices reach.
    int place(const std::filesystem::path& file, const Node& root);

  private:
    struct Placed {
        Scene scene; ///< without its vertices, indices, pictures
        int first_mesh = 0;
    };
    Placed& load(const std::filesystem::path& file);

    Scene& into_;
    std::map<std::filesystem::path, Placed> placed_;
};

/// Removes the textures that no material uses.
void drop_unused_textures(Scene& scene);

} // namespace bounce
