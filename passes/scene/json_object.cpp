#include "scene/json_object.h"

#include "core/json_text.h"
#include "core/scanner.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

using nlohmann::json;

static const json k_empty = json::object();

static bool is_real(const json& value) {
    return value.is_number() && std::abs(value.get<double>()) <= 1e30;
}

std::string json_shown(const json& value) {
    const bool numbers = value.is_array() && !value.empty() && value.size() <= 4 &&
                         std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_number(); });
    return numbers ? value.dump() : json_kind(value);
}

std::optional<glm::dvec3> json_vector(const json& value) {
    if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), is_real))
        return std::nullopt;
    return glm::dvec3(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
}

JsonObject::JsonObject(const json& value, std::string where, ErrorList& errors)
    : value_(&value), where_(std::move(where)), errors_(errors) {
    if (value.is_object()) return;
    errors_.add(fmt::format("{} must be an object, but is {}", where_.empty() ? "the file" : where_, json_kind(value)));
    value_ = &k_empty;
}

std::nullopt_t JsonObject::fail(const char* key, const std::string& wanted) {
    errors_.add(fmt::format("{} must be {}, but is {}", at(key), wanted, json_shown(value_->at(key))));
    return std::nullopt;
}

const json* JsonObject::find(const char* key) {
    known_.emplace_back(key);
    auto it = value_->find(key);
    return it == value_->end() ? nullptr : &*it;
}

void JsonObject::require(const char* key, const char* what) {
    if (!has(key)) errors_.add(fmt::format("{} is missing: {}", at(key), what));
}

std::optional<float> JsonObject::number(const char* key, double least, double most) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    bool inside = is_real(*value) && value->get<double>() >= least && value->get<double>() <= most;
    if (!inside) return fail(key, fmt::format("a number from {} to {}", least, most));
    return value->get<float>();
}

std::optional<int> JsonObject::whole(const char* key, int least, int most) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    bool inside = is_real(*value) && value->get<double>() >= least && value->get<double>() <= most &&
                  value->get<double>() == std::floor(value->get<double>());
    if (!inside) return fail(key, fmt::format("a whole number from {} to {}", least, most));
    return int(value->get<double>());
}

std::optional<bool> JsonObject::boolean(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_boolean()) return fail(key, "true or false");
    return value->get<bool>();
}

std::optional<std::string> JsonObject::text(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_string()) return fail(key, "text");
    return value->get<std::string>();
}

std::optional<glm::dvec3> JsonObject::vector(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    auto vector = json_vector(*value);
    if (!vector) return fail(key, "an array of 3 numbers, none above 1e30 in size");
    return vector;
}

std::optional<glm::vec3> JsonObject::colour(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    std::optional<glm::vec3> colour = json_vector(*value);
    if (is_real(*value)) colour = glm::vec3(value->get<float>());
    if (!colour || glm::any(glm::lessThan(*colour, glm::vec3(0))))
        return fail(key, "a number of 0 or more, or an array of 3 such (red, green, blue)");
    return colour;
}

std::optional<size_t> JsonObject::choice(const char* key, const std::vector<std::string>& names) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_string()) return fail(key, "one of " + join(names, ", "));
    const auto& name = value->get_ref<const std::string&>();
    auto it = std::find(names.begin(), names.end(), name);
    if (it != names.end()) return size_t(it - names.begin());
    errors_.add(fmt::format("{} is '{}', but must be one of {}{}", at(key), shortened(name), join(names, ", "),
                            nearest_name(name, names) ? did_you_mean(name, names) : ""));
    return std::nullopt;
}

void JsonObject::finish() {
    for (const auto& [key, value] : value_->items())
        if (std::find(known_.begin(), known_.end(), key) == known_.end())
            errors_.add(fmt::format("unknown key '{}'{}", at(shortened(key)), did_you_mean(key, known_)));
}

} // namespace bounce
