// Reads the `uniform … //! …` lines of shaders.
#include "core/error.h"
#include "core/parameters.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <regex>

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
    static const std::regex constructor(R"(^\s*[ib]?vec[234]\s*\(([^)]*)\)\s*$)");
    std::smatch match;
    if (std::regex_match(text, match, constructor)) text = match[1];
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

bool parse_parameter_line(std::string_view line, ParameterInfo& info) {
    size_t mark = line.find("//!");
    if (mark == std::string_view::npos) return false;
    static const std::regex declaration(R"(^\s*uniform\s+(\w+)\s+(\w+)\s*(?:=\s*([^;]+?)\s*)?;\s*$)");
    std::cmatch match;
    std::string before(trim(line.substr(0, mark)));
    if (!std::regex_match(before.c_str(), match, declaration)) return false;
    std::string type = match[1];
    if (type.find("sampler") != std::string::npos || type.find("image") != std::string::npos) return false;

    info = {};
    info.name = match[2];
    info.kind = kind_of_glsl(type);
    info.in_shader = true;

    std::string_view rest = trim(line.substr(mark + 3));
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
        if (info.kind != ParameterKind::integer || close == std::string_view::npos) {
            throw Error("the choices of '" + info.name + "' are written {a, b, c}, on a uniform int");
        }
        info.kind = ParameterKind::enumeration;
        info.choices = split(rest.substr(1, close - 1), ',');
        if (std::find(info.choices.begin(), info.choices.end(), "") != info.choices.end()) {
            throw Error("a choice of '" + info.name + "' has no name: they are written {a, b, c}");
        }
        rest = trim(rest.substr(close + 1));
    } else if (info.kind == ParameterKind::vec3) {
        info.kind = ParameterKind::colour;
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
    if (info.kind == ParameterKind::enumeration) as_number.kind = ParameterKind::integer;
    std::string text = match[3].matched ? plain_default(match[3]) : "0";
    try {
        info.default_value = parse_value(as_number, std::string_view(text));
        check_range(info, info.default_value);
    } catch (const Error& error) {
        throw Error(fmt::format("the default of '{}': {}", info.name, error.what()));
    }
    return true;
}

} // namespace bounce
