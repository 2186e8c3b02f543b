#include "core/image.h"
#include "core/json_text.h"
#include "scene/find_scene.h"
#include "scene/keyframes.h"
#include "scene/shot_parts.h"
#include "scene/turn.h"

#include <cmath>
#include <fmt/format.h>

namespace bounce {

using nlohmann::json;

void read_light(const json& value, const std::string& where, ErrorList& errors, Scene& scene) {
    static const std::vector<std::string> types{"point", "spot", "directional"}; // LightType's order
    JsonObject object(value, where, errors);
    object.require("type", "point, spot or directional");
    Light light;
    light.type = LightType(object.choice("type", types).value_or(0));
    light.name = object.text("name").value_or(fmt::format("{} {}", types[size_t(light.type)], scene.lights.size()));
    light.intensity = object.colour("intensity").value_or(glm::vec3(1));
    light.enabled = object.boolean("enabled").value_or(true);

    Node node;
    node.name = light.name;
    node.path = read_path(object, "path");
    bool path_aims = !node.path.empty() && node.path.keys.front().has_target;
    bool directional = light.type == LightType::directional;
    if (!directional && node.path.empty()) object.require("position", "where the light is, in metres");
    node.translation = object.vector("position").value_or(glm::dvec3(0));

    std::optional<glm::dvec3> direction = object.vector("direction"), target = object.vector("target");
    if (direction && target) errors.add(where + ": give a direction or a target, not both");
    if (light.type != LightType::point && !object.has("direction") && !object.has("target") && !path_aims)
        errors.add(object.at("direction") + " is missing: the way the light travels");
    if (target) direction = *target - node.translation;
    if (direction && *direction == glm::dvec3(0))
        errors.add(object.at(target ? "target" : "direction") + " gives no direction");
    if (direction) node.rotation = look_rotation(*direction, true);

    if (auto degrees = object.number("inner_cone_deg", 0, 90)) light.inner_cone = glm::radians(*degrees);
    if (auto degrees = object.number("outer_cone_deg", 0.01, 90)) light.outer_cone = glm::radians(*degrees);
    if (light.type == LightType::spot && light.inner_cone >= light.outer_cone)
        errors.add(fmt::format("{} ({:g}) must be less than outer_cone_deg ({:g}); both are half-angles",
                               object.at("inner_cone_deg"), glm::degrees(light.inner_cone),
                               glm::degrees(light.outer_cone)));
    light.radius = object.number("radius", 0, 1e6).value_or(0);
    if (auto degrees = object.number("angular_radius_deg", 0, 45)) light.angular_radius = glm::radians(*degrees);
    object.finish();

    node.light = int(scene.lights.size());
    scene.lights.push_back(std::move(light));
    scene.nodes.push_back(std::move(node));
}

static void read_map(const std::string& name, const std::filesystem::path& base, ErrorList& errors, Environment& to) {
    try {
        to.map = read_hdr(find_scene_file(name, base));
    } catch (const std::exception& error) {
        errors.add(std::string("environment: ") + error.what());
    }
}

Environment read_environment(const json& value, const std::filesystem::path& base, ErrorList& errors) {
    Environment out;
    if (value.is_string()) {
        out.radiance = glm::vec3(1);
        read_map(value.get<std::string>(), base, errors, out);
    } else if (value.is_object()) {
        JsonObject object(value, "environment", errors);
        auto map = object.text("map");
        auto scale = object.colour("scale");
        auto radiance = object.colour("radiance");
        if (object.has("map") == object.has("radiance"))
            errors.add("environment must have a map (an .hdr file, and perhaps a scale) or a radiance");
        if (object.has("scale") && object.has("radiance")) errors.add("environment.scale belongs to a map");
        out.radiance = map ? scale.value_or(glm::vec3(1)) : radiance.value_or(glm::vec3(0));
        if (map) read_map(*map, base, errors, out);
        object.finish();
    } else {
        json holder{{"environment", value}};
        JsonObject object(holder, "", errors);
        out.radiance = object.colour("environment").value_or(glm::vec3(0));
    }
    return out;
}

static std::optional<glm::dquat> read_rotation(JsonObject& object) {
    const json* value = object.find("rotation");
    if (!value) return std::nullopt;
    if (auto degrees = json_vector(*value)) return rotation_of(*degrees);
    bool four = value->is_array() && value->size() == 4;
    for (const json& item : *value)
        four = four && item.is_number() && std::isfinite(item.get<float>());
    if (four) {
        glm::dquat q((*value)[3].get<double>(), (*value)[0].get<double>(), (*value)[1].get<double>(),
                     (*value)[2].get<double>());
        if (glm::length(q) > 1e-6) return of_length_1(q);
    }
    object.errors().add(object.at("rotation") + " must be 3 angles in degrees or a quaternion x, y, z, w, but is " +
                        json_shown(*value));
    return std::nullopt;
}

static glm::dvec3 read_scale(JsonObject& object) {
    const json* value = object.find("scale");
    if (!value) return glm::dvec3(1);
    std::optional<glm::dvec3> scale = json_vector(*value);
    if (value->is_number() && std::isfinite(value->get<float>())) scale = glm::dvec3(value->get<double>());
    if (scale && scale->x * scale->y * scale->z != 0) return *scale;
    object.errors().add(object.at("scale") + " must be a number or an array of 3, none of them 0, but is " +
                        json_shown(*value));
    return glm::dvec3(1);
}

Node read_object(const json& value, const std::string& where, ErrorList& errors, std::string& scene_name) {
    JsonObject object(value, where, errors);
    object.require("scene", "the glTF file to place");
    scene_name = object.text("scene").value_or("");
    Node node;
    node.name = object.text("name").value_or(scene_name);
    node.translation = object.vector("position").value_or(glm::dvec3(0));
    node.rotation = read_rotation(object).value_or(node.rotation);
    node.scale = read_scale(object);
    node.path = read_path(object, "path");
    object.finish();
    return node;
}

} // namespace bounce
