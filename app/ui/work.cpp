#include "app/ui/work.h"

#include "app/ui/shot_writer.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/problem.h"
#include "core/text.h"
#include "scene/loaded_space.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

using nlohmann::json;

namespace {

constexpr size_t k_kept_files = 64;

std::string key_of(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal().string();
}

// --- a shot ----------------------------------------------------------------------------------------------------------

template <typename Vector>
json vector_json(const Vector& v) {
    json out = json::array();
    for (int i = 0; i < v.length(); ++i)
        out.push_back(v[i]);
    return out;
}

/// Throws when it is no vector of that length, or not finite.
template <typename Vector>
Vector vector_from(const json& value) {
    Vector v;
    if (!value.is_array() || int(value.size()) != v.length()) throw Error("a vector is of another length");
    for (int i = 0; i < v.length(); ++i) {
        v[i] = value.at(size_t(i)).template get<typename Vector::value_type>();
        if (!std::isfinite(v[i])) throw Error("a number is not finite");
    }
    return v;
}

json light_json(const Light& light, const Node* node, const Scene& scene) {
    json out{{"name", light.name},
             {"type", int(light.type)},
             {"node", node ? node - scene.nodes.data() : -1},
             {"intensity", vector_json(light.intensity)},
             {"cones", {light.inner_cone, light.outer_cone}},
             {"radius", light.radius},
             {"angular_radius", light.angular_radius},
             {"enabled", light.enabled}};
    if (!node || node->has_matrix) return out;
    out["translation"] = vector_json(node->translation);
    out["rotation"] = {node->rotation.w, node->rotation.x, node->rotation.y, node->rotation.z};
    out["scale"] = vector_json(node->scale);
    return out;
}

void set_light(const json& from, Light& light, Node* node) {
    if (from.at("name") != light.name) throw Error("its lights are others");
    light.intensity = vector_from<glm::vec3>(from.at("intensity"));
    const auto cones = vector_from<glm::vec2>(from.at("cones"));
    light.inner_cone = cones.x;
    light.outer_cone = cones.y;
    light.radius = from.at("radius").get<float>();
    light.angular_radius = from.at("angular_radius").get<float>();
    light.enabled = from.at("enabled").get<bool>();
    if (!node || !from.contains("translation")) return;
    node->translation = vector_from<glm::dvec3>(from.at("translation"));
    const auto r = vector_from<glm::dvec4>(from.at("rotation"));
    node->rotation = glm::normalize(glm::dquat(r.x, r.y, r.z, r.w));
    node->scale = vector_from<glm::dvec3>(from.at("scale"));
    node->has_matrix = false;
}

/// Lights that came or went: they are made anew, those of the file at their nodes, others at nodes of their own.
void place_lights(const json& lights, Scene& scene) {
    for (Node& node : scene.nodes)
        node.light = -1;
    const int known = int(scene.nodes.size());
    scene.lights.clear();
    for (const json& from : lights) {
        Light light;
        light.name = from.at("name").get<std::string>();
        const int type = from.at("type").get<int>(), at = from.at("node").get<int>();
        if (type < 0 || type > int(LightType::directional)) throw Error("a light's type is unknown");
        light.type = LightType(type);
        if (at >= known) scene.nodes.emplace_back().name = light.name;
        if (at >= 0) scene.nodes[size_t(std::min(at, int(scene.nodes.size()) - 1))].light = int(scene.lights.size());
        scene.lights.push_back(light);
    }
}

json names_of(const std::vector<Light>& lights) {
    json names = json::array();
    for (const Light& light : lights)
        names.push_back(light.name);
    return names;
}

json material_json(const Material& material) {
    return {{"name", material.name},
            {"base_colour", vector_json(material.base_colour)},
            {"metallic", material.metallic},
            {"roughness", material.roughness},
            {"emission", vector_json(material.emission)}};
}

void set_material(const json& from, Material& material) {
    if (from.at("name") != material.name) throw Error("its materials are others");
    material.base_colour = vector_from<glm::vec4>(from.at("base_colour"));
    material.metallic = from.at("metallic").get<float>();
    material.roughness = from.at("roughness").get<float>();
    material.emission = vector_from<glm::vec3>(from.at("emission"));
}

Node* node_of_light(Scene& scene, size_t light) {
    auto found =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.light == int(light); });
    return found == scene.nodes.end() ? nullptr : &*found;
}

json objects_json(const Shot& shot) {
    json objects = json::array();
    for (int index : shot.object_nodes) {
        const Node& node = shot.scene.nodes[size_t(index)];
        objects.push_back({{"name", node.name},
                           {"translation", vector_json(node.translation)},
                           {"rotation", {node.rotation.w, node.rotation.x, node.rotation.y, node.rotation.z}},
                           {"scale", vector_json(node.scale)}});
    }
    return objects;
}

void set_objects(const json& objects, const Shot& shot, Scene& scene) {
    if (objects.size() != shot.object_nodes.size()) throw Error("its objects are others");
    for (size_t i = 0; i < objects.size(); ++i) {
        Node& node = scene.nodes[size_t(shot.object_nodes[i])];
        if (objects[i].at("name") != node.name) throw Error("its objects are others");
        node.translation = vector_from<glm::dvec3>(objects[i].at("translation"));
        const auto r = vector_from<glm::dvec4>(objects[i].at("rotation"));
        node.rotation = glm::dquat(r.x, r.y, r.z, r.w);
        node.scale = vector_from<glm::dvec3>(objects[i].at("scale"));
        const bool flat = node.scale.x * node.scale.y * node.scale.z == 0;
        if (flat || std::abs(glm::length(node.rotation) - 1) > 1e-6) throw Error("an object has no shape");
    }
    check_placement(scene, shot.time);
}

json path_json(const Path& path) {
    json keys = json::array();
    for (const PathKey& key : path.keys)
        keys.push_back({{"t", key.t}, {"position", vector_json(key.position)}, {"target", vector_json(key.target)}});
    return keys;
}

Path path_from(const json& from) {
    Path path;
    for (const json& key : from) {
        path.keys.push_back({key.at("t").get<float>(), vector_from<glm::dvec3>(key.at("position")),
                             vector_from<glm::dvec3>(key.at("target")), true});
        if (path.keys.size() > 1 && !(path.keys.back().t > path.keys[path.keys.size() - 2].t))
            throw Error("its camera's path goes back in time");
    }
    return path;
}

json camera_work(const Camera& camera) {
    return {{"position", vector_json(camera.position)},
            {"target", vector_json(camera.target)},
            {"up", vector_json(camera.up)},
            {"vfov", camera.vfov}};
}

json shot_work(Session& session, const SceneBaseline& opened) {
    Shot& shot = session.shot();
    json work;
    if (session.camera_is_set()) work["camera"] = camera_work(session.camera());
    if (camera_path_edited(shot, opened) && !shot.camera_path.empty()) {
        work["camera_path"] = path_json(shot.camera_path);
        work["path_camera"] = camera_work(shot.camera);
    }
    if (edited_objects(shot, opened) > 0) work["objects"] = objects_json(shot);
    if (edited_lights(shot.scene, opened) > 0) {
        work["lights"] = json::array();
        // Some came or went: those that they were are told, so that they fit that file alone.
        if (names_of(shot.scene.lights) != names_of(opened.lights)) work["lights_of_file"] = names_of(opened.lights);
        for (size_t i = 0; i < shot.scene.lights.size(); ++i)
            work["lights"].push_back(light_json(shot.scene.lights[i], node_of_light(shot.scene, i), shot.scene));
    }
    if (edited_materials(shot.scene, opened) > 0) {
        for (const Material& material : shot.scene.materials)
            work["materials"].push_back(material_json(material));
    }
    if (shot.environment.radiance != opened.environment) work["environment"] = vector_json(shot.environment.radiance);
    if (shot.diffuse_only != opened.diffuse_only) work["diffuse_only"] = shot.diffuse_only;
    if (shot.normal_maps != opened.normal_maps) work["normal_maps"] = shot.normal_maps;
    if (shot.material_model != opened.material_model)
        work["material_model"] = std::string(k_material_models[size_t(shot.material_model)]);
    return work;
}

Camera camera_from(const json& from, Camera camera) {
    camera.position = vector_from<glm::vec3>(from.at("position"));
    camera.target = vector_from<glm::vec3>(from.at("target"));
    camera.up = vector_from<glm::vec3>(from.at("up"));
    camera.vfov = std::clamp(from.at("vfov").get<float>(), 0.001f, 3.1f);
    if (camera.position == camera.target) throw Error("its camera looks nowhere");
    return camera;
}

/// All of it or, when it throws, nothing.
void set_shot_work(Session& session, const json& work) {
    Shot& shot = session.shot();
    Scene scene = shot.scene;
    std::optional<Camera> camera;
    if (work.contains("camera")) camera = camera_from(work.at("camera"), session.camera());
    std::optional<Path> path;
    Camera path_camera = shot.camera;
    if (work.contains("camera_path")) {
        path = path_from(work.at("camera_path"));
        path_camera = camera_from(work.at("path_camera"), shot.camera);
    }
    if (work.contains("objects")) set_objects(work.at("objects"), shot, scene);
    const json lights = work.value("lights", json::array()), materials = work.value("materials", json::array());
    if (work.contains("lights_of_file")) {
        if (work.at("lights_of_file") != names_of(scene.lights)) throw Error("its lights are others");
        place_lights(lights, scene);
    }
    if (work.contains("lights") && lights.size() != scene.lights.size()) throw Error("its lights are others");
    for (size_t i = 0; i < lights.size(); ++i)
        set_light(lights[i], scene.lights[i], node_of_light(scene, i));
    if (!materials.empty() && materials.size() != scene.materials.size()) throw Error("its materials are others");
    for (size_t i = 0; i < materials.size(); ++i)
        set_material(materials[i], scene.materials[i]);
    glm::vec3 environment = shot.environment.radiance;
    if (work.contains("environment")) environment = vector_from<glm::vec3>(work.at("environment"));
    const bool diffuse_only = work.value("diffuse_only", shot.diffuse_only);
    const bool normal_maps = work.value("normal_maps", shot.normal_maps);
    const std::string model = work.value("material_model", std::string(k_material_models[size_t(shot.material_model)]));
    const auto known = std::find(k_material_models.begin(), k_material_models.end(), model);
    if (known == k_material_models.end()) throw Error("its material model is unknown");

    shot.scene.lights = std::move(scene.lights);
    shot.scene.nodes = std::move(scene.nodes);
    shot.scene.materials = std::move(scene.materials);
    shot.environment.radiance = environment;
    shot.diffuse_only = diffuse_only;
    shot.normal_maps = normal_maps;
    shot.material_model = MaterialModel(known - k_material_models.begin());
    if (path) {
        shot.camera_path = std::move(*path);
        shot.camera = path_camera;
    }
    if (camera) session.set_camera(*camera, true);
    session.scene_edited();
}

std::string describe_work(const Session& session, const SceneBaseline& opened, const json& work) {
    std::vector<std::string> parts;
    auto count = [&](size_t number, const char* what) {
        if (number) parts.push_back(fmt::format("{} {}{}", number, what, number == 1 ? "" : "s"));
    };
    if (work.contains("camera")) parts.emplace_back("the camera");
    if (work.contains("camera_path")) parts.emplace_back("the camera's path");
    count(edited_lights(session.shot().scene, opened), "light");
    count(edited_objects(session.shot(), opened), "object");
    count(edited_materials(session.shot().scene, opened), "material");
    if (work.contains("environment")) parts.emplace_back("the environment");
    if (work.contains("diffuse_only") || work.contains("normal_maps") || work.contains("material_model"))
        parts.emplace_back("how surfaces reflect");
    return join(parts, ", ");
}

// --- a graph ---------------------------------------------------------------------------------------------------------

/// Of a person in the window; what the command line said is no work.
json graph_work(const Session& session) {
    const GraphValues values = session.graph().model().values();
    json work;
    for (const GraphValues::Value& value : values.parameters)
        if (value.origin == ParameterOrigin::panel) work["set"][value.name] = value.text;
    for (const auto& [pass, on] : values.switches) {
        const auto& given = session.options().switches;
        bool asked = std::any_of(given.begin(), given.end(), [&](const auto& s) { return s.first == pass; });
        if (!asked) work["switch"][pass] = on;
    }
    return work;
}

void remember(std::map<std::string, std::string>& work, const std::string& key, const json& now) {
    if (now.empty()) {
        work.erase(key);
        return;
    }
    work[key] = json_dump(now, -1);
    for (auto it = work.begin(); work.size() > k_kept_files && it != work.end();)
        it = it->first == key ? std::next(it) : work.erase(it);
}

} // namespace

std::string shot_key(const Session& session) {
    return key_of(session.shot().path);
}

std::string graph_key(const Session& session) {
    return key_of(session.graph().model().file().path);
}

void keep_work(PanelContext& context) {
    WindowState& window = context.ui.window;
    remember(window.work.shots, shot_key(context.session), shot_work(context.session, window.opened));
    remember(window.work.graphs, graph_key(context.session), graph_work(context.session));
}

std::string edits_of_shot(PanelContext& context) {
    const SceneBaseline& opened = context.ui.window.opened;
    const json work = shot_work(context.session, opened);
    if (work.size() == size_t(work.contains("camera"))) return {};
    return describe_work(context.session, opened, work);
}

std::string restore_shot_work(PanelContext& context) {
    auto& shots = context.ui.window.work.shots;
    const auto found = shots.find(shot_key(context.session));
    if (found == shots.end()) return {};
    try {
        const json work = json::parse(found->second);
        set_shot_work(context.session, work);
        context.ui.redraw();
        return describe_work(context.session, context.ui.window.opened, work);
    } catch (const std::exception& problem) {
        shots.erase(found);
        context.ui.say("what was edited of this shot does not fit it any more: " + problem_text(problem), true);
        return {};
    }
}

std::string restore_graph_work(PanelContext& context, const std::set<std::string>& given) {
    auto& graphs = context.ui.window.work.graphs;
    const auto found = graphs.find(graph_key(context.session));
    if (found == graphs.end()) return {};
    Session& session = context.session;
    std::vector<std::string> names;
    const json work = json::parse(found->second, nullptr, false);
    if (!work.is_object()) return {};
    const json values = work.value("set", json::object()), switches = work.value("switch", json::object());
    for (const auto& [name, text] : values.items()) {
        if (given.contains(name) || !text.is_string()) continue;
        try {
            session.set_parameter(name, text.get<std::string>(), ParameterOrigin::panel);
            names.push_back(name + "=" + text.get<std::string>());
        } catch (const Error&) {
            // The graph or the shader has no such value any more.
        }
    }
    for (const auto& [pass, on] : switches.items()) {
        PassNode* node = session.graph().model().find_node(pass);
        if (!node || !on.is_boolean() || given.contains(pass) || node->enabled == on.get<bool>()) continue;
        node->enabled = on.get<bool>();
        names.push_back(pass + (node->enabled ? " on" : " off"));
    }
    if (!names.empty()) context.ui.redraw();
    return few_of(names);
}

std::string few_of(const std::vector<std::string>& names) {
    constexpr size_t k_told = 4;
    if (names.size() <= k_told) return join(names, ", ");
    return join(std::vector<std::string>(names.begin(), names.begin() + k_told), ", ") +
           fmt::format(" and {} more", names.size() - k_told);
}

} // namespace bounce
