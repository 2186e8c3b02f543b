#pragma once
// A shot: everything that makes a picture, in one JSON file (assets/shots/*.json). Everything that renders takes one.

#include "scene/material_model.h"
#include "scene/scene.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

/// A shot as loaded: the scene with its objects placed, and what the file says besides.
struct Shot {
    std::string name;           ///< file name without extension, or the scene's name
    std::filesystem::path path; ///< the file it came from
    Scene scene;                ///< file scene plus `objects`, lights by `lights_mode`, normal_maps applied
    Environment environment;
    /// Loaded (Scene::space), as all cameras are. When the shot names none: the file's first, else one that frames the
    /// bounds.
    Camera camera;
    Path camera_path;              ///< in the file's coordinates; empty unless the shot has one
    std::vector<Path> light_paths; ///< per Scene::lights entry, to look at; Node::path is what moves the light
    std::vector<int> object_nodes; ///< per entry of the file's `objects`: the node that places it, which has no parent
    int width = 1280;
    int height = 720;
    float time = 0; ///< seconds of frame 0
    float fps = 60;
    /// The materials are as authored: who shades reads ρ = base colour · (1 − metallic), and no specular lobe.
    bool diffuse_only = false;
    MaterialModel material_model = MaterialModel::gltf; ///< without effect where diffuse_only is set
    bool normal_maps = true;

    /// The model that surfaces are shaded by: Lambert is the plain sum without its second lobe.
    MaterialModel effective_model() const { return diffuse_only ? MaterialModel::plain : material_model; }
    /// Seconds at frame i: time + i / fps.
    float time_at(int frame) const { return time + float(frame) / fps; }
};

/// The shot at one frame.
struct ShotState {
    SceneState scene;
    Camera camera;
    float time = 0;
};

/// Loads a shot (.json), or wraps a .gltf/.glb in a default one. `name` may be a path, or the name of a shot in
/// the assets' shots folder. Throws Error with every problem of the file.
Shot load_shot(const std::string& name);
ShotState evaluate_shot(const Shot& shot, int frame);
SceneFacts shot_facts(const Shot& shot);

/// Loads one glTF file (.gltf, .glb). Throws Error; what it skips is in Scene::notes.
Scene load_gltf(const std::filesystem::path& path);

/// Finds a scene by path or by name ("sponza/Sponza.gltf", "cornell"): relative to `base`, then the search path:
/// $BOUNCE_SCENES (colon separated), the assets' scenes folder, and ../shared/scenes beside the source tree. Throws
/// Error naming the places tried.
std::filesystem::path find_scene(const std::string& name, const std::filesystem::path& base);

/// The camera as JSON text for a shot file ({"position":…}), for captures and bookmarks: in the file's coordinates.
std::string camera_json(const Camera& camera, const LoadedSpace& space);

} // namespace bounce
