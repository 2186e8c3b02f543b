// Reads the `uniform … //! …` lines of shaders.
#include "core/parameter_line.h"
#include "core/error.h"
#include "core/parameter_steps.h"
#include "core/scanner.h"
#include "core/source_lines.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

static ParameterKind kind_of_glsl(const std::string& type) {
    if (type == "bool") return ParameterKind::boolean;
    if (type == "int") return ParameterKind::integer;
    if (type == "float") return ParameterKind::real;
    if (type == "vec2") return ParameterKind::vec2;
    if (type == "vec3") return ParameterKind::vec3;
    if (type == "vec4") return ParameterKind::vec4;
    throw Error("a parameter cannot be of type '" + type + "'; it is a bool, int, float, vec2, vec3 or vec4");
}

/// "vec3(1, 0.5f, 0)" → "1,0.5,0"; "1.0f" → "1.0".
static std::string plain_default(std::string text) {
    Scanner scanner(text);
    std::string_view type = scanner.space().word();
    if (!type.empty() && (type[0] == 'i' || type[0] == 'b')) type.remove_prefix(1);
    if ((type == "vec2" || type == "vec3" || type == "vec4") && scanner.space().take('(')) {
        auto inside = scanner.until(')');
        if (inside && scanner.space().at_end()) text = std::string(*inside);
    }
    std::vector<std::string> parts = split(text, ',');
    for (std::string& part : parts) {
        if (part.size() > 1 && (part.back() == 'f' || part.back() == 'F')) {
            if (part.find_first_not_of("0123456789.+-eE") == part.size() - 1) part.pop_back();
        }
        if (!part.empty() && part.back() == '.') part += "0";
        if (!part.empty() && part.front() == '.') part = "0" + part;
    }
    return join(parts, ",");
}

/// "uniform float x = 1.0;": its three parts; the default may be empty.
namespace {
struct UniformLine {
    std::string type, name, value;
};
} // namespace

static std::optional<UniformLine> read_declaration(std::string_view code) {
    Scanner scanner(code);
    if (!scanner.space().take_word("uniform")) return std::nullopt;
    std::string_view type = scanner.space().word(), name = scanner.space().word();
    if (type.empty() || name.empty()) return std::nullopt;
    UniformLine declaration{std::string(type), std::string(name), ""};
    bool has_value = scanner.space().take('=');
    auto value = scanner.until(';');
    if (!value || !scanner.space().at_end() || trim(*value).empty() == has_value) return std::nullopt;
    declaration.value = std::string(trim(*value));
    return declaration;
}

bool parse_parameter_line(std::string_view line, ParameterInfo& info) {
    std::optional<CodeLine> read = CodeLines({std::string(line)}).next();
    return read && read->mark && parse_parameter_line(read->code, *read->mark, info);
}

bool parse_parameter_line(std::string_view code, std::string_view mark, ParameterInfo& info) {
    std::optional<UniformLine> declaration = read_declaration(code);
    if (!declaration) return false;
    const std::string& type = declaration->type;
    if (type.find("sampler") != std::string::npos || type.find("image") != std::string::npos) return false;

    info = {};
    info.name = declaration->name;
    info.kind = kind_of_glsl(type);
    info.in_shader = true;

    std::string_view rest = trim(mark);
    if (rest.starts_with("static") && (rest.size() == 6 || rest[6] == ' ')) {
        info.is_static = true;
        rest = trim(rest.substr(6));
    }
    if (rest.starts_with("[")) {
        size_t close = rest.find(']');
        std::vector<std::string> ends =
            close == std::string_view::npos ? std::vector<std::string>{} : split(rest.substr(1, close - 1), ',');
        ParameterInfo number;
        number.name = info.name;
        if (ends.size() != 2) throw Error("the range of '" + info.name + "' is written [least, greatest]");
        info.min = std::get<float>(parse_value(number, std::string_view(ends[0])));
        info.max = std::get<float>(parse_value(number, std::string_view(ends[1])));
        if (info.min > info.max) throw Error("the range of '" + info.name + "' is empty: least is above greatest");
        rest = trim(rest.substr(close + 1));
    } else if (rest.starts_with("{")) {
        size_t close = rest.find('}');
        std::vector<std::string> choices;
        if (close != std::string_view::npos) choices = split(rest.substr(1, close - 1), ',');
        const bool scalar = info.kind == ParameterKind::integer || info.kind == ParameterKind::real;
        if (scalar && are_numbers(choices)) {
            choose_from(info, choices);
        } else if (info.kind != ParameterKind::integer || close == std::string_view::npos) {
            throw Error("the choices of '" + info.name +
                        "' are written {a, b, c}, on a uniform int, or as numbers: {32, 64, 128}");
        } else if (std::find(choices.begin(), choices.end(), "") != choices.end()) {
            throw Error("a choice of '" + info.name + "' has no name: they are written {a, b, c}");
        } else {
            info.kind = ParameterKind::enumeration;
            info.choices = choices;
        }
        rest = trim(rest.substr(close + 1));
    } else if (info.kind == ParameterKind::vec3) {
        info.kind = ParameterKind::colour;
    }
    // What "auto" follows may stand behind the range: "[4, 256] auto(cones) cones of the set".
    if (rest.starts_with("auto(")) {
        const size_t close = rest.find(')');
        info.automatic = close == std::string_view::npos ? "" : std::string(trim(rest.substr(5, close - 5)));
        if (info.automatic.empty()) throw Error("what 'auto' of '" + info.name + "' follows is written auto(need)");
        rest = trim(rest.substr(close + 1));
    }
    // A unit may stand in parentheses before the help: "[0, 4] (voxels) start offset".
    if (rest.starts_with("(")) {
        size_t close = rest.find(')');
        if (close != std::string_view::npos) {
            info.unit = std::string(trim(rest.substr(1, close - 1)));
            rest = trim(rest.substr(close + 1));
        }
    }
    info.help = std::string(rest);

    ParameterInfo as_number = info;
    if (info.kind == ParameterKind::enumeration) {
        as_number.kind = ParameterKind::integer;
        as_number.choices.clear();
    }
    std::string text = declaration->value.empty() ? "0" : plain_default(declaration->value);
    try {
        info.default_value = parse_value(as_number, std::string_view(text));
        check_range(info, info.default_value);
    } catch (const Error& error) {
        throw Error(fmt::format("the default of '{}': {}", info.name, error.what()));
    }
    return true;
}

} // namespace bounce
