#include "scene/shot.h"

#include "core/asset_files.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/paths.h"
#include "core/text.h"
#include "scene/find_scene.h"
#include "scene/gltf_parts.h"
#include "scene/keyframes.h"
#include "scene/loaded_space.h"
#include "scene/merge.h"
#include "scene/scene_formats.h"
#include "scene/shot_parts.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

class ShotReader {
  public:
    ShotReader(const fs::path& path, const json& root) : base_(path.parent_path()), object_(root, "", errors_) {
        shot_.path = path;
        shot_.name = path.stem().string();
    }

    Shot read() {
        object_.text("about");
        shot_.width = object_.whole("width", 1, k_max_picture_side).value_or(shot_.width);
        shot_.height = object_.whole("height", 1, k_max_picture_side).value_or(shot_.height);
        shot_.time = object_.number("time", -1e6, 1e6).value_or(0);
        shot_.fps = object_.number("fps", 0.001, 100000).value_or(shot_.fps);
        shot_.diffuse_only = object_.boolean("diffuse_only").value_or(false);
        const std::vector<std::string> models(k_material_models.begin(), k_material_models.end());
        if (auto model = object_.choice("material_model", models)) shot_.material_model = MaterialModel(*model);
        shot_.normal_maps = object_.boolean("normal_maps").value_or(true);
        shot_.camera_path = read_path(object_, "camera_path");
        bool path_aims = !shot_.camera_path.empty() && shot_.camera_path.keys.front().has_target;
        if (object_.has("camera_path") && !object_.has("camera") && !path_aims)
            errors_.add("camera_path has no targets, and there is no camera to say which way it looks");
        if (const json* value = object_.find("environment"))
            shot_.environment = read_environment(*value, base_, errors_);
        read_scene();
        read_objects();
        read_lights();
        shot_.scene.space = suitable_space(shot_.scene);
        if (const json* value = object_.find("camera")) shot_.camera = read_camera(*value, shot_.scene.space, errors_);
        object_.finish();
        errors_.throw_if_any(shot_.path.string());

        if (!shot_.normal_maps) {
            for (Material& material : shot_.scene.materials)
                material.normal_texture = {};
            drop_unused_textures(shot_.scene);
        }
        mark_dynamic_nodes(shot_.scene);
        complete_shot(shot_, object_.has("camera") || !shot_.camera_path.empty(), false);
        return std::move(shot_);
    }

  private:
    void read_scene() {
        object_.require("scene", "a glTF file, or the name of one on the scene search path");
        auto name = object_.text("scene");
        if (!name) return;
        try {
            shot_.scene = load_scene(find_scene(*name, base_));
        } catch (const Error& error) {
            errors_.add(std::string("scene: ") + error.what());
        }
    }

    void read_objects() {
        const json* objects = object_.find("objects");
        if (!objects) return;
        if (!objects->is_array()) return errors_.add("objects must be an array, but is " + json_kind(*objects));
        SceneMerger merger(shot_.scene);
        for (size_t i = 0; i < objects->size(); ++i) {
            std::string where = fmt::format("objects[{}]", i), name;
            size_t before = errors_.messages().size();
            Node node = read_object((*objects)[i], where, errors_, name);
            if (errors_.messages().size() > before && name.empty()) continue;
            try {
                shot_.object_nodes.push_back(merger.place(find_scene(name, base_), node));
            } catch (const Error& error) {
                errors_.add(where + ".scene: " + error.what());
            }
        }
    }

    void read_lights() {
        const json* lights = object_.find("lights");
        if (lights && !lights->is_array()) return errors_.add("lights must be an array, but is " + json_kind(*lights));
        bool names_any = lights && !lights->empty();
        // "add" and "replace", in this order; a shot that names lights means those.
        bool replace = object_.choice("lights_mode", {"add", "replace"}).value_or(names_any ? 1 : 0) == 1;
        Scene& scene = shot_.scene;
        if (replace) {
            scene.lights.clear();
            for (Node& node : scene.nodes)
                node.light = -1;
        }
        for (size_t i = 0; lights && i < lights->size(); ++i)
            read_light((*lights)[i], fmt::format("lights[{}]", i), errors_, scene);
    }

    fs::path base_;
    ErrorList errors_;
    JsonObject object_;
    Shot shot_;
};

/// What a panel shows; the nodes' own paths are what moves the lights.
void collect_light_paths(Shot& shot) {
    shot.light_paths.assign(shot.scene.lights.size(), Path{});
    for (const Node& node : shot.scene.nodes)
        if (node.light >= 0) shot.light_paths[size_t(node.light)] = node.path;
}

Shot wrap_scene(const fs::path& path) {
    Shot shot;
    shot.path = path;
    shot.scene = load_scene(path);
    shot.name = shot.scene.name;
    shot.scene.space = suitable_space(shot.scene);
    complete_shot(shot, false, true);
    return shot;
}

} // namespace

fs::path find_shot(const std::string& name) {
    std::error_code ignored;
    if (fs::is_regular_file(name, ignored)) return name;
    if (const std::string kind = irregular_kind(name); !kind.empty() && kind != "a folder")
        throw Error("cannot read '" + name + "': it is " + kind + "; expected a regular file");
    for (const fs::path& candidate : {assets_folder() / "shots" / (name + ".json"), assets_folder() / "shots" / name})
        if (!name.empty() && fs::is_regular_file(candidate, ignored)) return candidate;
    if (fs::path(name).extension() == ".json")
        throw Error("no shot '" + name + "'" + did_you_mean(fs::path(name).stem().string(), asset_names("shots")));
    if (scene_format_of(name)) return find_given_scene(name);
    try {
        return find_given_scene(name);
    } catch (const Error& error) {
        throw Error("no shot '" + name + "' in " + (assets_folder() / "shots").string() +
                    did_you_mean(name, asset_names("shots")) + ", and " + error.what());
    }
}

Shot load_shot(const std::string& name) {
    fs::path path = find_shot(name);
    Shot shot;
    if (scene_format_of(path)) {
        shot = wrap_scene(path);
    } else if (path.extension() == ".json") {
        json root = read_json_file(path);
        shot = ShotReader(path, root).read();
    } else {
        throw Error(path.string() + ": not a shot: expected a file that ends in .json, " + scene_extensions());
    }
    collect_light_paths(shot);
    return shot;
}

ShotState evaluate_shot(const Shot& shot, int frame) {
    ShotState state;
    state.time = shot.time_at(frame);
    // Frame 0 has no frame before it: nothing has moved yet.
    state.scene = evaluate_scene(shot.scene, state.time, shot.time_at(std::max(frame - 1, 0)));
    state.camera = shot.camera;
    if (!shot.camera_path.empty()) {
        PathKey key = shot.camera_path.at(state.time);
        // Without targets the camera travels along the path and keeps the way it looks.
        glm::vec3 ahead = shot.camera.target - shot.camera.position;
        state.camera.position = shot.scene.space.to_loaded(key.position);
        state.camera.target = key.has_target ? shot.scene.space.to_loaded(key.target) : state.camera.position + ahead;
    }
    return state;
}

} // namespace bounce
