#include "core/error.h"
#include "scene/default_view.h"
#include "scene/extent.h"
#include "scene/keyframes.h"
#include "scene/loaded_space.h"
#include "scene/shot_parts.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtx/component_wise.hpp>

namespace bounce {

using nlohmann::json;

Path read_path(JsonObject& object, const char* key) {
    const json* value = object.find(key);
    if (!value) return {};
    Path path;
    if (!value->is_array() || value->empty()) {
        object.errors().add(object.at(key) + " must be an array of keys {t, position, target}");
        return {};
    }
    size_t targets = 0;
    bool ordered = true;
    for (size_t i = 0; i < value->size(); ++i) {
        JsonObject from((*value)[i], fmt::format("{}[{}]", object.at(key), i), object.errors());
        from.require("t", "seconds");
        from.require("position", "where it is at t, in metres");
        PathKey to;
        to.t = from.number("t", -1e6, 1e6).value_or(0);
        to.position = from.vector("position").value_or(glm::dvec3(0));
        to.has_target = from.has("target");
        to.target = from.vector("target").value_or(glm::dvec3(0));
        from.finish();
        targets += to.has_target;
        ordered = ordered && (path.keys.empty() || to.t > path.keys.back().t);
        path.keys.push_back(to);
    }
    if (!ordered) object.errors().add(object.at(key) + ": t must increase from key to key");
    if (targets != 0 && targets != path.keys.size())
        object.errors().add(object.at(key) + ": either all keys have a target, or none");
    return path;
}

Camera read_camera(const json& value, const LoadedSpace& space, ErrorList& errors) {
    JsonObject object(value, "camera", errors);
    Camera camera;
    object.require("position", "where the camera is, in metres");
    object.require("target", "the point it looks at");
    camera.name = object.text("name").value_or("");
    const auto position = object.vector("position"), target = object.vector("target");
    if (position) camera.position = space.to_loaded(*position);
    if (target) camera.target = space.to_loaded(*target);
    if (auto up = object.vector("up")) {
        // Only its direction counts.
        const double most = glm::compMax(glm::abs(*up));
        camera.up = most > 0 ? glm::vec3(*up / most) : glm::vec3(0);
    }
    if (auto degrees = object.number("vfov_deg", 0.1, 170)) camera.vfov = glm::radians(*degrees);
    camera.near_plane = float(object.number("near", 0, 1e9).value_or(0) / space.unit);
    if (position && target && *position == *target)
        errors.add("camera.target is the camera's position: it must lie in front of it");
    else if (position && target && camera.position == camera.target)
        errors.add("camera.target is so near to camera.position that floats cannot tell them apart: expected a target "
                   "further off");
    if (glm::length(camera.up) == 0) errors.add("camera.up must not be zero");
    object.finish();
    return camera;
}

std::string camera_json(const Camera& camera, const LoadedSpace& space) {
    // The shortest text that reads back.
    auto number = [](auto v) { return json(std::stod(fmt::format("{}", v))); };
    auto direction = [&](const glm::vec3& v) { return json::array({number(v.x), number(v.y), number(v.z)}); };
    auto place = [&](const glm::vec3& v) {
        if (space == LoadedSpace{}) return direction(v);
        const glm::dvec3 file = space.to_file(v);
        return json::array({number(file.x), number(file.y), number(file.z)});
    };
    nlohmann::ordered_json out;
    out["position"] = place(camera.position);
    out["target"] = place(camera.target);
    out["up"] = direction(camera.up);
    out["vfov_deg"] = number(glm::degrees(camera.vfov));
    if (camera.near_plane > 0) out["near"] = number(float(camera.near_plane * space.unit));
    return out.dump();
}

static bool any_emission(const Scene& scene) {
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0)
            for (const Primitive& primitive : scene.meshes[size_t(node.mesh)].primitives)
                if (scene.materials[size_t(primitive.material)].is_emissive()) return true;
    return false;
}

static void add_default_light(Shot& shot, const DefaultView& view) {
    Bounds bounds = scene_extent(shot.scene, shot.time).bounds;
    bool dark_inside = view.kind != ViewKind::outside && view.sky_share < 0.05f && !bounds.empty();
    Light light;
    light.name = "default light";
    Node node;
    node.name = light.name;
    if (dark_inside) {
        // Sunlight would not get in: a lamp in the upper middle, as bright as gives the far walls about 1 W/m².
        light.type = LightType::point;
        const double diagonal = bounds.diagonal() * shot.scene.space.unit;
        light.intensity = glm::vec3(float(0.1 * diagonal * diagonal));
        node.translation = shot.scene.space.to_file(bounds.min + glm::vec3(0.5f, 0.7f, 0.5f) * bounds.size());
    } else {
        light.type = LightType::directional;
        light.intensity = glm::vec3(3);
        node.rotation = look_rotation(glm::vec3(-0.35f, -1, -0.25f), true);
    }
    node.light = int(shot.scene.lights.size());
    shot.scene.lights.push_back(light);
    shot.scene.nodes.push_back(node);
    shot.environment.radiance = glm::vec3(0.1f);
    shot.scene.notes.push_back(fmt::format("the file has no light: {} and a faint environment were added",
                                           dark_inside ? "a point light in the upper middle" : "a directional light"));
}

void complete_shot(Shot& shot, bool has_camera, bool add_light) {
    float aspect = float(shot.width) / float(shot.height);
    check_placement(shot.scene, shot.time);
    if (has_camera) check_place(evaluate_shot(shot, 0).camera.position, "the shot's camera");
    SceneState state = evaluate_scene(shot.scene, shot.time, shot.time);
    bool lit = !shot.scene.lights.empty() || any_emission(shot.scene) || shot.environment.present();
    bool wants_view = !has_camera && state.cameras.empty();
    DefaultView view;
    if (wants_view || (add_light && !lit)) view = default_view(shot.scene, aspect);
    if (!has_camera && !state.cameras.empty()) {
        shot.camera = state.cameras.front();
        // A glTF camera has no target; orbiting wants one about where the scene is.
        Bounds bounds = scene_extent(shot.scene, shot.time, {&shot.camera, 1}).bounds;
        glm::vec3 forward = shot.camera.target - shot.camera.position;
        float ahead = bounds.empty() ? 1 : glm::dot(bounds.centre() - shot.camera.position, forward);
        float distance = std::max(ahead, 0.1f * bounds.diagonal());
        shot.camera.target = shot.camera.position + forward * (distance > 0 ? distance : 1.0f);
    } else if (!has_camera) {
        shot.camera = view.camera;
        shot.scene.notes.push_back("neither the shot nor the file has a camera: a default view was chosen");
    }
    if (lit) return;
    if (add_light)
        add_default_light(shot, view);
    else
        shot.scene.notes.push_back("the shot has no light, no emission and no environment: its pictures are black");
}

} // namespace bounce
