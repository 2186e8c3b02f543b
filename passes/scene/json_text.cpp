#include "scene/json_text.h"

#include "core/error.h"

#include <fmt/format.h>

namespace bounce {

using nlohmann::json;

// The library writes "[json.exception.parse_error.101] parse error at line 1, column 2: …"; the tag says nothing to a
// person.
static std::string without_tag(const std::string& text) {
    size_t end = text.find("] ");
    return text.rfind("[json.", 0) == 0 && end != std::string::npos ? text.substr(end + 2) : text;
}

json parse_json(std::string_view text, const std::string& what, bool comments) {
    auto limit_depth = [&](int depth, json::parse_event_t event, json&) {
        bool opens = event == json::parse_event_t::object_start || event == json::parse_event_t::array_start;
        if (opens && depth > k_max_json_depth)
            throw Error(fmt::format("{}: nested more than {} levels deep", what, k_max_json_depth));
        return true;
    };
    try {
        return json::parse(text, limit_depth, true, comments);
    } catch (const json::exception& error) {
        throw Error(what + ": not valid JSON: " + without_tag(error.what()));
    }
}

std::string json_kind(const json& value) {
    switch (value.type()) {
    case json::value_t::null:
        return "null";
    case json::value_t::object:
        return "an object";
    case json::value_t::array:
        return fmt::format("an array of {}", value.size());
    case json::value_t::boolean:
        return value.get<bool>() ? "true" : "false";
    case json::value_t::string: {
        const auto& text = value.get_ref<const std::string&>();
        return "the text '" + (text.size() > 40 ? text.substr(0, 40) + "…" : text) + "'";
    }
    default:
        return value.dump();
    }
}

} // namespace bounce
