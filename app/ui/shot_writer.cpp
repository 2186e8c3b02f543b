#include "app/ui/shot_writer.h"

#include "app/ui/captures.h"
#include "core/error.h"
#include "core/image.h"
#include "core/json_text.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "scene/find_scene.h"
#include "scene/keyframes.h"
#include "scene/turn.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

/// The shortest decimal that reads back as the same float.
json number(float value) {
    return json::parse(fmt::format("{}", value));
}

json vector(const glm::vec3& v) {
    return {number(v.x), number(v.y), number(v.z)};
}

/// A place in the file's coordinates: as a float where that tells it all.
json place(const glm::dvec3& v) {
    auto coordinate = [](double value) {
        return double(float(value)) == value ? number(float(value)) : json::parse(fmt::format("{}", value));
    };
    return {coordinate(v.x), coordinate(v.y), coordinate(v.z)};
}

/// What is computed with further, in doubles: as it is.
json exact(double value) {
    return json::parse(fmt::format("{}", value));
}

json exact(const glm::dvec3& v) {
    return {exact(v.x), exact(v.y), exact(v.z)};
}

bool same_light(const Light& a, const Light& b) {
    return a.intensity == b.intensity && a.inner_cone == b.inner_cone && a.outer_cone == b.outer_cone &&
           a.radius == b.radius && a.angular_radius == b.angular_radius && a.enabled == b.enabled;
}

bool same_place(const Node& a, const Node& b) {
    return a.translation == b.translation && a.rotation == b.rotation && a.has_matrix == b.has_matrix;
}

bool same_object(const Node& a, const Node& b) {
    return a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale;
}

bool same_path(const Path& a, const Path& b) {
    return std::equal(
        a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(), [](const PathKey& x, const PathKey& y) {
            return x.t == y.t && x.position == y.position && x.target == y.target && x.has_target == y.has_target;
        });
}

bool same_view(const Camera& a, const Camera& b) {
    return a.position == b.position && a.target == b.target && a.up == b.up && a.vfov == b.vfov;
}

const Node* node_of(const Scene& scene, int light) {
    auto found =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) { return node.light == light; });
    return found == scene.nodes.end() ? nullptr : &*found;
}

bool lights_edited(const Scene& scene, const SceneBaseline& opened) {
    return edited_lights(scene, opened) > 0;
}

json path_json(const Path& path) {
    json keys = json::array();
    for (const PathKey& key : path.keys) {
        json out{{"t", number(key.t)}, {"position", exact(key.position)}};
        if (key.has_target) out["target"] = exact(key.target);
        keys.push_back(out);
    }
    return keys;
}

/// Round degrees, or others, that read back as the same angle; the nearest where none do.
json degrees(float angle) {
    const float plain = glm::degrees(angle);
    const float round = std::round(plain * 1000) / 1000;
    for (float value : {round, plain, std::nextafter(plain, 0.0f), std::nextafter(plain, 1000.0f)})
        if (glm::radians(value) == angle) return number(value);
    return number(plain);
}

json light_json(const Light& light, const Node* node, const glm::dmat4& world) {
    static const char* const types[] = {"point", "spot", "directional"};
    json out;
    if (!light.name.empty()) out["name"] = light.name;
    out["type"] = types[size_t(light.type)];
    if (light.type != LightType::directional) out["position"] = place(glm::dvec3(world[3]));
    if (light.type != LightType::point) out["direction"] = vector(glm::vec3(-glm::normalize(glm::dvec3(world[2]))));
    out["intensity"] = vector(light.intensity);
    if (light.type == LightType::spot) {
        out["inner_cone_deg"] = degrees(light.inner_cone);
        out["outer_cone_deg"] = degrees(light.outer_cone);
    }
    if (light.radius > 0) out["radius"] = number(light.radius);
    if (light.angular_radius > 0) out["angular_radius_deg"] = degrees(light.angular_radius);
    if (!light.enabled) out["enabled"] = false;
    if (node && !node->path.empty()) out["path"] = path_json(node->path);
    return out;
}

/// Round angles where they say it all, else the quaternion.
json rotation_json(const glm::dquat& rotation) {
    const glm::dvec3 round = glm::round(1000.0 * angles_of(rotation)) / 1000.0 + 0.0; // no -0
    if (rotation_of(round) == rotation) return exact(round);
    const glm::dquat q = of_length_1(rotation);
    return {exact(q.x), exact(q.y), exact(q.z), exact(q.w)};
}

/// What was edited of one of `objects` replaces what its file says.
void set_object(json& object, const Node& now, const Node& opened) {
    if (now.translation != opened.translation) object["position"] = exact(now.translation);
    if (now.rotation != opened.rotation) object["rotation"] = rotation_json(now.rotation);
    if (now.scale != opened.scale) {
        object["scale"] = now.scale == glm::dvec3(now.scale.x) ? exact(now.scale.x) : exact(now.scale);
    }
}

json lights_json(const Session& session) {
    const Scene& scene = session.shot().scene;
    std::vector<glm::dmat4> worlds = file_matrices(scene, session.time());
    json lights = json::array();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Node* node = node_of(scene, int(i));
        if (!node) continue; // shines nowhere
        lights.push_back(light_json(scene.lights[i], node, worlds[size_t(node - scene.nodes.data())]));
    }
    return lights;
}

/// How a shot in `folder` names a file: files name others by relative paths only.
std::string name_from(const fs::path& folder, const fs::path& file) {
    return fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(fs::absolute(folder))).string();
}

/// The name under which a file that was `name` beside the old shot is found from the new one.
template <typename Find>
std::string moved_name(const std::string& name, const fs::path& from, const fs::path& to, Find find) {
    fs::path meant = fs::weakly_canonical(find(name, from));
    try {
        if (fs::weakly_canonical(find(name, to)) == meant) return name;
    } catch (const Error&) {
    }
    return name_from(to, meant);
}

/// The file that the shot came from, with names that hold in `folder`; for a plain scene a new shot of it.
json original(const Shot& shot, const fs::path& folder) {
    if (shot.path.extension() != ".json") return {{"scene", name_from(folder, shot.path)}};
    json root = read_json_file<json>(shot.path);
    fs::path from = shot.path.parent_path();
    auto scene = [&](json& holder) {
        holder["scene"] = moved_name(holder.at("scene").get<std::string>(), from, folder, find_scene);
    };
    scene(root);
    if (root.contains("objects")) {
        for (json& object : root["objects"])
            scene(object);
    }
    if (root.contains("environment")) {
        json& environment = root["environment"];
        json* map = environment.is_string()                                  ? &environment
                    : environment.is_object() && environment.contains("map") ? &environment["map"]
                                                                             : nullptr;
        if (map) *map = moved_name(map->get<std::string>(), from, folder, find_scene_file);
    }
    return root;
}

void set_environment(json& root, const Environment& environment) {
    if (environment.map.empty()) {
        root["environment"] = vector(environment.radiance);
        return;
    }
    json& old = root["environment"];
    json map = old.is_object() ? old["map"] : old;
    old = json{{"map", map}, {"scale", vector(environment.radiance)}};
}

} // namespace

size_t edited_lights(const Scene& scene, const SceneBaseline& opened) {
    if (scene.lights.size() != opened.lights.size()) return std::max(scene.lights.size(), size_t(1));
    size_t edited = 0;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Node* node = node_of(scene, int(i));
        edited += !same_light(scene.lights[i], opened.lights[i]) || (node && !same_place(*node, opened.light_nodes[i]));
    }
    return edited;
}

size_t edited_objects(const Shot& shot, const SceneBaseline& opened) {
    size_t edited = 0;
    for (size_t i = 0; i < shot.object_nodes.size() && i < opened.object_nodes.size(); ++i)
        edited += !same_object(shot.scene.nodes[size_t(shot.object_nodes[i])], opened.object_nodes[i]);
    return edited;
}

bool camera_path_edited(const Shot& shot, const SceneBaseline& opened) {
    return !same_path(shot.camera_path, opened.camera_path);
}

size_t edited_materials(const Scene& scene, const SceneBaseline& opened) {
    size_t edited = 0;
    for (size_t i = 0; i < scene.materials.size() && i < opened.materials.size(); ++i) {
        const Material &a = scene.materials[i], &b = opened.materials[i];
        edited += a.base_colour != b.base_colour || a.metallic != b.metallic || a.roughness != b.roughness ||
                  a.emission != b.emission;
    }
    return edited;
}

std::string shot_text(const Session& session, const SceneBaseline& opened, const fs::path& folder) {
    const Shot& shot = session.shot();
    json root = original(shot, folder);
    bool plain_scene = shot.path.extension() != ".json";
    root["width"] = session.size().x;
    root["height"] = session.size().y;
    root["time"] = number(session.time());
    root["fps"] = number(shot.fps);
    if (session.camera_is_set() || (shot.camera_path.empty() && !root.contains("camera_path"))) {
        root["camera"] = json::parse(camera_json(session.camera(), shot.scene.space));
        root.erase("camera_path");
    } else if (camera_path_edited(shot, opened)) {
        // The path has where and whither, the camera the rest.
        if (!root.contains("camera") || !same_view(shot.camera, opened.camera))
            root["camera"] = json::parse(camera_json(shot.camera, shot.scene.space));
        root["camera_path"] = path_json(shot.camera_path);
    }
    for (size_t i = 0; i < shot.object_nodes.size() && i < opened.object_nodes.size(); ++i)
        set_object(root.at("objects").at(i), shot.scene.nodes[size_t(shot.object_nodes[i])], opened.object_nodes[i]);
    // A default light of a plain scene is no part of its file.
    bool default_light = plain_scene && !shot.scene.lights.empty() && shot.scene.lights.back().name == "default light";
    if (default_light || lights_edited(shot.scene, opened)) {
        root["lights_mode"] = "replace";
        root["lights"] = lights_json(session);
    }
    bool environment_edited = shot.environment.radiance != opened.environment;
    if (environment_edited || (plain_scene && shot.environment.present())) set_environment(root, shot.environment);
    if (shot.diffuse_only || root.contains("diffuse_only")) root["diffuse_only"] = shot.diffuse_only;
    if (shot.material_model != MaterialModel::gltf || root.contains("material_model"))
        root["material_model"] = std::string(k_material_models[size_t(shot.material_model)]);
    if (!shot.normal_maps || root.contains("normal_maps")) root["normal_maps"] = shot.normal_maps;
    return json_dump(root, 2) + "\n";
}

bool differs_from_shot(const Session& session, const SceneBaseline& opened) {
    const Shot& shot = session.shot();
    return session.camera_is_set() || camera_path_edited(shot, opened) || lights_edited(shot.scene, opened) ||
           edited_objects(shot, opened) > 0 || shot.environment.radiance != opened.environment ||
           shot.diffuse_only != opened.diffuse_only || shot.normal_maps != opened.normal_maps ||
           shot.material_model != opened.material_model;
}

std::string unsaved_edits(const Session& session, const SceneBaseline& opened) {
    const size_t edited = edited_materials(session.shot().scene, opened);
    std::string text;
    if (edited) text = fmt::format("{} edited material{}: shot files hold none", edited, edited == 1 ? "" : "s");
    if (session.camera_is_set() && camera_path_edited(session.shot(), opened))
        text += std::string(text.empty() ? "" : "; ") + "the camera path: the camera was moved away from it";
    return text;
}

/// What would be written for `folder`, or empty where that fails.
static std::string state_text(const PanelContext& context, const fs::path& folder) {
    try {
        return shot_text(context.session, context.ui.window.opened, folder);
    } catch (const std::exception&) {
        return {};
    }
}

static fs::path write_shot(PanelContext& context, const fs::path& path) {
    CaptureState& capture = context.ui.window.capture;
    std::string text;
    try {
        text = shot_text(context.session, context.ui.window.opened, path.parent_path());
    } catch (const nlohmann::json::exception& problem) {
        throw Error("'" + context.session.shot().path.string() +
                    "' is not the shot that was opened any more: " + problem.what());
    }
    write_file_atomically(path, text);
    capture.saved_shot = path.lexically_normal().string();
    capture.saved_state = text;
    context.ui.say("saved " + capture.saved_shot);
    return path;
}

fs::path save_shot(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    fs::path folder = capture.folder.empty() ? fs::path(".") : fs::path(capture.folder);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error("cannot create the folder '" + folder.string() + "': " + error.message());
    return write_shot(context, new_file(folder.string(), context.session.shot().name + "_view", ".json"));
}

fs::path save_shot_in_list(PanelContext& context, const std::string& name) {
    const auto good = [](char c) { return is_word_character(c) || c == '-'; };
    if (name.empty() || name.size() > 100 || !std::all_of(name.begin(), name.end(), good))
        throw Error("invalid name '" + name + "' of a shot: expected letters, digits and underscores");
    const fs::path path = assets_folder() / "shots" / (name + ".json");
    std::error_code ignored;
    if (fs::exists(path, ignored)) throw Error("'" + path.string() + "' is there already: take another name");
    return write_shot(context, path);
}

/// For a shell: quoted where a name needs it.
static std::string quoted(const std::string& text) {
    if (text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%") ==
        std::string::npos)
        return text;
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string reproducing_command(const PanelContext& context) {
    const Session& session = context.session;
    const CaptureState& capture = context.ui.window.capture;
    std::string line = session.command_line("picture.png");
    if (!differs_from_shot(session, context.ui.window.opened)) return line;
    if (capture.saved_shot.empty() ||
        state_text(context, fs::path(capture.saved_shot).parent_path()) != capture.saved_state)
        return {};
    // The saved shot begins at the time that is shown: its first frame is the picture.
    std::string start = "bounce render " + session.options().shot;
    std::string rest = line.substr(std::min(start.size(), line.size()));
    std::string frames = fmt::format(" --frames {}", session.frame() + 1);
    if (size_t at = rest.find(frames); session.frame() > 0 && at != std::string::npos) rest.erase(at, frames.size());
    return "bounce render " + quoted(capture.saved_shot) + rest;
}

} // namespace bounce
