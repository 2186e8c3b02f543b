#include "app/experiments/table_file.h"

#include "core/asset_files.h"
#include "core/json_text.h"
#include "core/metric_table.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

using nlohmann::ordered_json;

std::filesystem::path find_table(const std::string& name) {
    return find_asset("tables", "table", name);
}

ordered_json read_table(const std::filesystem::path& path) {
    ordered_json json = read_json_file<ordered_json>(path);
    if (!json.is_object()) throw Error(path.string() + ": a table is an object {…}");
    return json;
}

void check_keys(const ordered_json& object, const std::string& where, const std::vector<std::string>& known,
                ErrorList& errors) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end())
            errors.add(fmt::format("{}: there is no key '{}'{}", where, key, did_you_mean(key, known)));
    }
}

std::string text_at(const ordered_json& object, const char* key, const std::string& where, ErrorList& errors,
                    bool required) {
    if (object.contains(key) && object[key].is_string()) return object[key].get<std::string>();
    if (object.contains(key) || required) errors.add(fmt::format("{}: '{}' must be a text", where, key));
    return {};
}

std::string set_text(const ordered_json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

ParameterValues sets_at(const ordered_json& object, const std::string& where, ErrorList& errors) {
    ParameterValues sets;
    if (!object.contains("set")) return sets;
    if (!object["set"].is_object()) {
        errors.add(where + ": 'set' must be {\"pass.parameter\": value}");
        return sets;
    }
    for (const auto& [parameter, value] : object["set"].items())
        sets.emplace_back(parameter, set_text(value));
    return sets;
}

std::vector<std::string> metrics_at(const ordered_json& object, const std::string& where, ErrorList& errors) {
    std::vector<std::string> names;
    if (!object["metrics"].is_array()) errors.add(where + ": 'metrics' must be a list of names");
    for (const ordered_json& name : object["metrics"]) {
        try {
            names.push_back(find_metric(set_text(name)).name);
        } catch (const Error& error) {
            errors.add(where + ", metrics: " + error.what());
        }
    }
    return names;
}

} // namespace bounce
