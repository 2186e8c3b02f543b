#include "core/parameters.h"

#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace bounce {

const char* to_string(ParameterOrigin origin) {
    switch (origin) {
    case ParameterOrigin::default_value:
        return "default";
    case ParameterOrigin::graph:
        return "graph";
    case ParameterOrigin::command_line:
        return "command line";
    case ParameterOrigin::panel:
        return "panel";
    }
    return "";
}

static int component_count(ParameterKind kind) {
    switch (kind) {
    case ParameterKind::vec2:
        return 2;
    case ParameterKind::vec3:
    case ParameterKind::colour:
        return 3;
    case ParameterKind::vec4:
        return 4;
    default:
        return 1;
    }
}

static std::vector<double> components(const ParameterValue& value) {
    return std::visit(
        [](const auto& v) -> std::vector<double> {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_arithmetic_v<T>)
                return {double(v)};
            else {
                std::vector<double> parts;
                for (int i = 0; i < v.length(); ++i)
                    parts.push_back(v[i]);
                return parts;
            }
        },
        value);
}

static ParameterValue from_components(ParameterKind kind, const std::vector<double>& c) {
    switch (kind) {
    case ParameterKind::boolean:
        return c[0] != 0;
    case ParameterKind::integer:
    case ParameterKind::enumeration:
        return int(c[0]);
    case ParameterKind::real:
        return float(c[0]);
    case ParameterKind::vec2:
        return glm::vec2(c[0], c[1]);
    case ParameterKind::vec3:
    case ParameterKind::colour:
        return glm::vec3(c[0], c[1], c[2]);
    case ParameterKind::vec4:
        return glm::vec4(c[0], c[1], c[2], c[3]);
    }
    return 0.0f;
}

std::string range_text(const ParameterInfo& info) {
    if (!info.choices.empty()) return "{" + join(info.choices, ", ") + "}";
    if (std::isinf(info.min) && std::isinf(info.max)) return "";
    return fmt::format("[{}, {}]", float(info.min), float(info.max));
}

std::string ParameterInfo::default_text() const {
    return auto_by_default ? k_auto : to_text(*this, default_value);
}

std::string Parameter::text() const {
    return is_auto ? k_auto : to_text(info, value);
}

static std::string expectation(const ParameterInfo& info) {
    static const char* const names[] = {
        "true or false",         "a whole number",         "one of",          "a number", "two numbers (x,y)",
        "three numbers (x,y,z)", "four numbers (x,y,z,w)", "a colour (r,g,b)"};
    std::string range = range_text(info);
    const std::string by_need = info.automatic.empty() ? "" : ", or auto";
    if (!info.choices.empty()) return "one of " + range + by_need;
    return std::string(names[int(info.kind)]) + (range.empty() ? "" : " " + range) + by_need;
}

[[noreturn]] static void fail(const ParameterInfo& info, std::string_view got) {
    throw Error(fmt::format("'{}' is not a value for parameter '{}': it takes {}", got, info.name, expectation(info)));
}

static bool parse_number(std::string_view text, double& number) {
    text = trim(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

/// Whether a number is one of those that the parameter takes.
static bool is_step(const ParameterInfo& info, double number) {
    if (info.kind == ParameterKind::enumeration || info.choices.empty()) return true;
    return std::any_of(info.choices.begin(), info.choices.end(), [&](const std::string& choice) {
        double step = 0;
        return parse_number(choice, step) && float(step) == float(number);
    });
}

ParameterValue value_for(const ParameterInfo& info, double need) {
    double number = std::clamp(need, info.min, info.max);
    if (info.kind == ParameterKind::integer) number = std::round(number);
    if (info.kind == ParameterKind::enumeration || info.choices.empty()) return from_components(info.kind, {number});
    for (const std::string& choice : info.choices) { // rising
        double step = 0;
        if (parse_number(choice, step) && (step >= number * (1 - 1e-9) || &choice == &info.choices.back()))
            return from_components(info.kind, {step});
    }
    return info.default_value;
}

void check_range(const ParameterInfo& info, const ParameterValue& value) {
    for (double c : components(value)) {
        bool in_choices = info.kind != ParameterKind::enumeration || (c >= 0 && c < double(info.choices.size()));
        // Compare as floats: 0.1 typed by a person must equal the 0.1 that bounds the range.
        if (std::isfinite(c) && float(c) >= float(info.min) && float(c) <= float(info.max) && in_choices &&
            is_step(info, c))
            continue;
        throw Error(fmt::format("'{}' is out of range for parameter '{}': it takes {}", to_text(info, value), info.name,
                                expectation(info)));
    }
}

std::string to_text(const ParameterInfo& info, const ParameterValue& value) {
    if (info.kind == ParameterKind::boolean) return std::get<bool>(value) ? "true" : "false";
    if (info.kind == ParameterKind::enumeration) {
        int index = std::get<int>(value);
        return index >= 0 && index < int(info.choices.size()) ? info.choices[index] : std::to_string(index);
    }
    if (info.kind == ParameterKind::integer) return std::to_string(std::get<int>(value));
    std::vector<std::string> parts;
    for (double c : components(value))
        parts.push_back(fmt::format("{}", float(c)));
    return join(parts, ",");
}

nlohmann::json to_json(const ParameterInfo& info, const ParameterValue& value) {
    switch (info.kind) {
    case ParameterKind::boolean:
        return std::get<bool>(value);
    case ParameterKind::integer:
        return std::get<int>(value);
    case ParameterKind::enumeration:
        return to_text(info, value);
    default:
        break;
    }
    nlohmann::json array = nlohmann::json::array();
    // The shortest decimal that reads back as the same float, so files hold 0.1 and not 0.10000000149.
    for (double c : components(value))
        array.push_back(nlohmann::json::parse(fmt::format("{}", float(c))));
    return array.size() == 1 ? array[0] : array;
}

ParameterValue parse_value(const ParameterInfo& info, std::string_view text) {
    text = trim(text);
    if (info.kind == ParameterKind::boolean) {
        if (text == "true" || text == "on" || text == "1") return true;
        if (text == "false" || text == "off" || text == "0") return false;
        fail(info, text);
    }
    if (info.kind == ParameterKind::enumeration) {
        for (size_t i = 0; i < info.choices.size(); ++i) {
            if (info.choices[i] == text) return int(i);
        }
        throw Error(
            fmt::format("'{}' is not a choice of parameter '{}'{}", text, info.name, did_you_mean(text, info.choices)));
    }
    std::vector<double> numbers;
    for (const std::string& part : split(text, ',')) {
        double number = 0;
        if (!parse_number(part, number)) fail(info, text);
        numbers.push_back(number);
    }
    size_t wanted = component_count(info.kind);
    if (numbers.size() == 1 && wanted > 1) numbers.resize(wanted, numbers[0]);
    if (numbers.size() != wanted) fail(info, text);
    if (info.kind == ParameterKind::integer &&
        (numbers[0] != std::floor(numbers[0]) || std::abs(numbers[0]) > 2147483647.0)) {
        fail(info, text);
    }
    ParameterValue value = from_components(info.kind, numbers);
    check_range(info, value);
    return value;
}

ParameterValue parse_value(const ParameterInfo& info, const nlohmann::json& json) {
    if (json.is_string()) return parse_value(info, std::string_view(json.get_ref<const std::string&>()));
    if (json.is_boolean() && info.kind == ParameterKind::boolean) return json.get<bool>();
    bool numeric = json.is_number() && info.kind != ParameterKind::boolean && info.kind != ParameterKind::enumeration;
    if (json.is_array()) {
        numeric = component_count(info.kind) > 1;
        for (const auto& element : json)
            numeric = numeric && element.is_number();
    }
    if (!numeric) fail(info, json.dump());
    std::string text;
    if (json.is_array()) {
        for (const auto& element : json)
            text += (text.empty() ? "" : ",") + element.dump();
    } else {
        text = json.dump();
    }
    return parse_value(info, std::string_view(text));
}

void ParameterSet::insert(Parameter parameter) {
    if (find(parameter.info.name)) throw Error("parameter '" + parameter.info.name + "' is declared twice");
    parameters_.push_back(std::move(parameter));
}

void ParameterSet::declare_shader_parameter(const ParameterInfo& info) {
    Parameter* old = find(info.name);
    if (!old) {
        insert({info, info.default_value, ParameterOrigin::default_value, {}, info.auto_by_default});
        return;
    }
    if (!old->info.in_shader) return; // a C++ parameter of that name feeds the uniform
    bool same_kind = old->info.kind == info.kind;
    ParameterValue value = old->value;
    ParameterOrigin origin = old->origin;
    const bool still_auto = old->is_auto && old->info.automatic == info.automatic;
    const std::string reason = std::exchange(old->reason, "");
    old->info = info;
    old->value = info.default_value;
    old->origin = ParameterOrigin::default_value;
    old->is_auto = info.auto_by_default;
    if (!same_kind || origin == ParameterOrigin::default_value) return;
    try {
        check_range(info, value);
        old->value = value;
        old->origin = origin;
        old->is_auto = still_auto;
        if (still_auto) old->reason = reason;
    } catch (const Error&) {
        // The new range excludes the old value: the default stands.
    }
}

void ParameterSet::keep_shader_parameters(const std::vector<std::string>& names) {
    std::erase_if(parameters_, [&](const Parameter& p) {
        return p.info.in_shader && std::find(names.begin(), names.end(), p.info.name) == names.end();
    });
}

Parameter* ParameterSet::find(std::string_view name) {
    return const_cast<Parameter*>(std::as_const(*this).find(name));
}

const Parameter* ParameterSet::find(std::string_view name) const {
    for (const Parameter& parameter : parameters_) {
        if (parameter.info.name == name) return &parameter;
    }
    return nullptr;
}

static Parameter& require(ParameterSet& set, std::string_view name) {
    if (Parameter* parameter = set.find(name)) return *parameter;
    throw Error(fmt::format("there is no parameter '{}'{}", name, did_you_mean(name, set.names())));
}

void ParameterSet::set(std::string_view name, const ParameterValue& value, ParameterOrigin origin) {
    Parameter& parameter = require(*this, name);
    if (value.index() != parameter.info.default_value.index()) {
        throw Error(fmt::format("parameter '{}' takes {}", name, expectation(parameter.info)));
    }
    check_range(parameter.info, value);
    parameter.value = value;
    parameter.origin = origin;
    parameter.is_auto = false;
    parameter.reason.clear();
    if (parameter.write_through) parameter.write_through(value);
}

void ParameterSet::set_text(std::string_view name, std::string_view text, ParameterOrigin origin) {
    Parameter& parameter = require(*this, name);
    if (trim(text) != k_auto || parameter.info.automatic.empty()) {
        set(name, parse_value(parameter.info, text), origin);
        return;
    }
    parameter.origin = origin;
    parameter.is_auto = true;
}

void ParameterSet::set_json(std::string_view name, const nlohmann::json& json, ParameterOrigin origin) {
    if (json.is_string()) {
        set_text(name, json.get_ref<const std::string&>(), origin);
        return;
    }
    set(name, parse_value(require(*this, name).info, json), origin);
}

void ParameterSet::follow_need(std::string_view name, const std::string& need) {
    require(*this, name).info.automatic = need;
}

void ParameterSet::resolve(std::string_view name, double need, const std::string& reason) {
    Parameter& parameter = require(*this, name);
    const ParameterOrigin origin = parameter.origin;
    set(name, value_for(parameter.info, need), origin);
    parameter.is_auto = true;
    parameter.reason = reason;
}

void ParameterSet::reset(std::string_view name) {
    Parameter& parameter = require(*this, name);
    set(name, parameter.info.default_value, ParameterOrigin::default_value);
    parameter.is_auto = parameter.info.auto_by_default;
}

std::vector<std::string> ParameterSet::names() const {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters_)
        names.push_back(parameter.info.name);
    return names;
}

} // namespace bounce
