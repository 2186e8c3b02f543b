#include "core/json_text.h"

#include "core/error.h"
#include "core/input_file.h"
#include "core/scanner.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace bounce {

using nlohmann::json;

// The library writes "[json.exception.parse_error.101] parse error at line 1, column 2: …"; the tag says nothing to a
// person, and what was read last may be all of a file.
std::string json_problem(const json::exception& error) {
    std::string_view text = error.what();
    size_t end = text.find("] ");
    if (text.starts_with("[json.") && end != std::string_view::npos) text.remove_prefix(end + 2);
    if (text.size() <= 300) return std::string(text);
    return shortened(text.substr(0, 120)) + shortened(text.substr(text.size() - 40));
}

/// "parse error at line 3, column 7: syntax error …" → "`what`:3: not valid JSON: column 7: syntax error …".
static std::string located(const std::string& problem, const std::string& what) {
    Scanner scanner(problem);
    if (scanner.take("parse error at line ")) {
        std::optional<int> line = scanner.number(9);
        if (line && scanner.take(", "))
            return fmt::format("{}:{}: not valid JSON: {}", what, *line, trim(scanner.rest()));
    }
    return what + ": not valid JSON: " + problem;
}

namespace {

/// Counts what the parser tells it.
template <class Json>
class Guard {
  public:
    Guard(const std::string& what, size_t max_values, bool keys_once)
        : what_(what), max_values_(max_values), keys_once_(keys_once) {}

    bool operator()(int depth, typename Json::parse_event_t event, Json& value) {
        using Event = typename Json::parse_event_t;
        bool opens = event == Event::object_start || event == Event::array_start;
        if (opens && depth >= k_max_json_depth)
            throw Error(fmt::format("{}: nested more than {} levels deep", what_, k_max_json_depth));
        if ((opens || event == Event::value) && ++values_ > max_values_)
            throw Error(fmt::format("{}: more than {} values", what_, max_values_));
        if (!keys_once_) return true;
        if (event == Event::object_start) keys_.emplace_back();
        if (event == Event::object_end && !keys_.empty()) keys_.pop_back();
        if (event == Event::key && !keys_.empty()) {
            const auto& name = value.template get_ref<const std::string&>();
            if (!keys_.back().insert(name).second)
                throw Error(
                    fmt::format("{}: not valid JSON: an object has the key '{}' twice", what_, shortened(name)));
        }
        return true;
    }

  private:
    const std::string& what_;
    size_t max_values_;
    bool keys_once_;
    size_t values_ = 0;
    std::vector<std::set<std::string>> keys_;
};

} // namespace

template <class Json>
Json parse_json(std::string_view text, const std::string& what, JsonComments comments, size_t max_bytes) {
    if (text.size() > max_bytes)
        throw Error(fmt::format("{}: {} of JSON: expected at most {}", what, format_bytes(double(text.size())),
                                format_bytes(double(max_bytes))));
    // The library takes a zero byte for the end, but a zero byte in a comment for the end of the comment. Scenes of
    // other programs may be padded with them.
    if (const size_t zero = text.find('\0'); comments == JsonComments::allowed && zero != text.npos)
        throw Error(fmt::format("{}:{}: not valid JSON: a zero byte", what,
                                1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(zero), '\n')));
    // Large scenes may hold more.
    Guard<Json> guard(what, max_bytes > k_max_json_text ? 5 * k_max_json_values : k_max_json_values,
                      comments == JsonComments::allowed);
    try {
        return Json::parse(text, std::ref(guard), true, comments == JsonComments::allowed);
    } catch (const json::exception& error) {
        throw Error(located(json_problem(error), what));
    }
}

template <class Json>
Json read_json_file(const std::filesystem::path& path) {
    return parse_json<Json>(read_file(path, k_max_json_text), path.string(), JsonComments::allowed);
}

template json parse_json(std::string_view, const std::string&, JsonComments, size_t);
template nlohmann::ordered_json parse_json(std::string_view, const std::string&, JsonComments, size_t);
template json read_json_file(const std::filesystem::path&);
template nlohmann::ordered_json read_json_file(const std::filesystem::path&);

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
    case json::value_t::string:
        return "the text '" + shortened(value.get_ref<const std::string&>()) + "'";
    default:
        return value.dump();
    }
}

} // namespace bounce
