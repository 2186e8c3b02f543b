#include "app/experiments/stability_rung.h"

#include "app/experiments/table_file.h"
#include "core/image.h"
#include "core/text.h"
#include "graph/expression.h"
#include "scene/quad_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace bounce {

using nlohmann::ordered_json;

namespace {

constexpr int k_max_repeats = 4096;

double value_of(const std::string& expression, const StabilityNames& names) {
    Names scope = [&](const std::string& name) -> std::optional<double> {
        const auto found = names.find(name);
        return found == names.end() ? std::nullopt : std::optional(found->second);
    };
    scope.known = [&] {
        std::vector<std::string> known;
        for (const auto& [name, value] : names)
            known.push_back(name);
        return known;
    };
    return evaluate(expression, scope);
}

double number_of(const ordered_json& value, const std::string& where, const StabilityNames& names) {
    if (value.is_number()) return value.get<double>();
    if (value.is_string() && value.get_ref<const std::string&>().starts_with("="))
        return value_of(value.get<std::string>().substr(1), names);
    throw Error(where + ": expected a number, or an expression \"=…\"");
}

/// Expressions as numbers, and repeated elements one by one.
ordered_json resolved(const ordered_json& value, const StabilityNames& names) {
    if (value.is_string() && value.get_ref<const std::string&>().starts_with("=")) {
        const double number = value_of(value.get<std::string>().substr(1), names);
        if (number == std::floor(number) && std::abs(number) < 1e15) return int64_t(number); // as a count is written
        return number;
    }
    if (value.is_object()) {
        ordered_json out = ordered_json::object();
        for (const auto& [key, member] : value.items())
            out[key] = resolved(member, names);
        return out;
    }
    if (!value.is_array()) return value;
    ordered_json out = ordered_json::array();
    for (const ordered_json& element : value) {
        if (!element.is_object() || !element.contains("repeat")) {
            out.push_back(resolved(element, names));
            continue;
        }
        const double count = number_of(element["repeat"], "repeat", names);
        if (!(count >= 0 && count <= k_max_repeats) || !element.contains("of"))
            throw Error(fmt::format("invalid repeat: expected {{\"repeat\": 0 … {}, \"of\": …}}", k_max_repeats));
        StabilityNames own = names;
        for (int i = 0; i < int(count); ++i) {
            own["i"] = i;
            out.push_back(resolved(element["of"], own));
        }
    }
    return out;
}

glm::vec3 vector_of(const ordered_json& value, const std::string& where) {
    if (value.is_number()) return glm::vec3(value.get<float>());
    if (value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() && value[2].is_number())
        return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
    throw Error(where + ": expected three numbers");
}

std::vector<glm::vec3> corners_of(const ordered_json& value, size_t count, const std::string& where) {
    if (!value.is_array() || value.size() != count) throw Error(fmt::format("{}: expected {} points", where, count));
    std::vector<glm::vec3> out;
    for (const ordered_json& corner : value)
        out.push_back(vector_of(corner, where));
    return out;
}

/// The parts of one scene, in their order.
class SceneMaker {
  public:
    QuadScene scene;

    void add(const ordered_json& parts, const std::string& where) {
        if (!parts.is_array()) throw Error(where + ": a scene is a list of parts");
        for (size_t i = 0; i < parts.size(); ++i)
            add_part(parts[i], fmt::format("{}[{}]", where, i));
    }

  private:
    void add_part(const ordered_json& part, const std::string& where) {
        if (!part.is_object()) throw Error(where + ": a part is an object");
        ErrorList errors;
        check_keys(part, where,
                   {"if", "quad", "box", "name", "parts", "instance", "copy", "position", "scale", "colour", "emission",
                    "roughness", "metallic"},
                   errors);
        errors.throw_if_any(where);
        if (part.contains("if") && number_of(part["if"], where, {}) == 0) return;
        const size_t first = scene.size();
        if (part.contains("quad")) {
            const auto c = corners_of(part["quad"], 4, where + ".quad");
            scene.quad(c[0], c[1], c[2], c[3]);
        } else if (part.contains("box")) {
            const auto c = corners_of(part["box"], 2, where + ".box");
            scene.box(c[0], c[1]);
        } else if (part.contains("name") && part.contains("parts")) {
            add(part["parts"], where + ".parts");
            groups_[part["name"].get<std::string>()] = {first, scene.size() - first};
            return;
        } else if (part.contains("instance") || part.contains("copy")) {
            place(part, where);
            return;
        } else {
            throw Error(where + ": expected a quad, a box, a name with parts, an instance or a copy");
        }
        QuadScene::Look look;
        if (part.contains("colour")) look.colour = vector_of(part["colour"], where + ".colour");
        if (part.contains("emission")) look.emission = vector_of(part["emission"], where + ".emission");
        if (part.contains("roughness")) look.roughness = float(number_of(part["roughness"], where, {}));
        if (part.contains("metallic")) look.metallic = float(number_of(part["metallic"], where, {}));
        scene.look(first, look);
    }

    void place(const ordered_json& part, const std::string& where) {
        const bool shares = part.contains("instance");
        const ordered_json& named = part[shares ? "instance" : "copy"];
        const auto group = named.is_string() ? groups_.find(named.get<std::string>()) : groups_.end();
        if (group == groups_.end()) throw Error(where + ": there is no part of that name before it");
        glm::mat4 to_world(1);
        if (part.contains("position"))
            to_world = glm::translate(to_world, vector_of(part["position"], where + ".position"));
        if (part.contains("scale")) to_world = glm::scale(to_world, vector_of(part["scale"], where + ".scale"));
        const auto [first, count] = group->second;
        shares ? scene.instance(first, count, to_world) : scene.copy(first, count, to_world);
    }

    std::map<std::string, std::pair<size_t, size_t>> groups_;
};

} // namespace

StabilityNames names_of_rung(const StabilityCase& which, double rung, bool against, int bounces) {
    StabilityNames names = {{"bounces", bounces}, {which.step, rung}};
    if (against && which.against.contains(which.step))
        names[which.step] = number_of(which.against[which.step], "against." + which.step, names);
    for (const auto& [name, value] : which.names.items()) {
        const bool replaced = against && which.against.contains(name);
        names[name] = number_of(replaced ? which.against[name] : value, "names." + name, names);
    }
    return names;
}

std::string write_rung(const StabilityCase& which, const StabilityNames& names, const std::filesystem::path& folder) {
    if (which.shot.is_string()) return which.shot.get<std::string>();
    ordered_json shot = resolved(which.shot, names);
    for (const auto& [name, parts] : which.scenes.items()) {
        SceneMaker maker;
        maker.add(resolved(parts, names), "scenes." + name);
        const bool reversed = names.contains("reversed") && names.at("reversed") != 0;
        (reversed ? maker.scene.reversed() : maker.scene).write(folder, name);
    }
    shot["scene"] = which.scenes.begin().key() + ".gltf";
    shot["width"] = which.size.x;
    shot["height"] = which.size.y;
    if (!shot.contains("lights_mode")) shot["lights_mode"] = "replace";
    const std::filesystem::path path = folder / (which.name + ".json");
    write_file_atomically(path, shot.dump());
    return path.string();
}

ParameterValues sets_of_rung(const StabilityCase& which, const StabilityNames& names,
                             const std::vector<std::string>& parameters) {
    ParameterValues sets;
    for (const auto& [name, value] : which.sets.items())
        if (std::find(parameters.begin(), parameters.end(), name) != parameters.end())
            sets.emplace_back(name, set_text(resolved(value, names)));
    return sets;
}

double expected_of(const StabilityCase& which, const StabilityNames& names) {
    return value_of(which.expected, names);
}

} // namespace bounce
