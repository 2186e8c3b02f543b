#include "app/experiments/sweep.h"

#include "core/asset_files.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/metric_table.h"
#include "core/text.h"

#include <fmt/format.h>

namespace bounce {

using nlohmann::ordered_json;

std::vector<ParameterValues> Sweep::combinations() const {
    double count = 1;
    for (const auto& [name, values] : lists)
        count *= double(values.size());
    for (const auto& [name, values] : each)
        count += double(values.size());
    if (count > double(k_max_sweep_points))
        throw Error(fmt::format("invalid sweep: its lists have {:.0f} combinations; expected at most {}", count,
                                grouped(k_max_sweep_points)));
    std::vector<ParameterValues> out = {base};
    for (const auto& [name, values] : lists) {
        std::vector<ParameterValues> next;
        for (const ParameterValues& so_far : out) {
            for (const std::string& value : values) {
                next.push_back(so_far);
                next.back().emplace_back(name, value);
            }
        }
        out = std::move(next);
    }
    for (const auto& [name, values] : each) {
        for (const std::string& value : values) {
            out.push_back(base);
            out.back().emplace_back(name, value);
        }
    }
    return out;
}

/// A value as --set takes it.
static std::string text_of(const ordered_json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const ordered_json& part : value)
        text += (text.empty() ? "" : ",") + part.dump();
    return text;
}

Sweep load_sweep(const std::string& name) {
    const std::filesystem::path path = find_asset("sweeps", "sweep", name);
    ordered_json json = read_json_file<ordered_json>(path);
    ErrorList errors;
    Sweep sweep;
    const std::vector<std::string> keys = {"about", "base", "lists", "each", "enable", "disable", "metric"};
    if (!json.is_object()) throw Error(path.string() + ": a sweep is an object {\"base\": {…}, \"lists\": {…}}");
    if (json.contains("groups"))
        throw Error(path.string() + ": this sweep is a chart of all methods: expected bounce chart --all");
    for (const auto& [key, value] : json.items()) {
        if (key == "about" && value.is_string())
            sweep.about = value.get<std::string>();
        else if (key == "metric" && value.is_string()) {
            try {
                sweep.metric = find_metric(value.get<std::string>()).name;
            } catch (const Error& error) {
                errors.add(std::string("metric: ") + error.what());
            }
        } else if ((key == "enable" || key == "disable") && value.is_array()) {
            for (const ordered_json& id : value)
                sweep.switches.emplace_back(text_of(id), key == "enable");
        } else if (key == "base" && value.is_object()) {
            for (const auto& [parameter, v] : value.items())
                sweep.base.emplace_back(parameter, text_of(v));
        } else if ((key == "lists" || key == "each") && value.is_object()) {
            for (const auto& [parameter, list] : value.items()) {
                if (!list.is_array() || list.empty()) {
                    errors.add(key + "." + parameter + " must be a list of at least one value");
                    continue;
                }
                std::vector<std::string> values;
                for (const auto& v : list)
                    values.push_back(text_of(v));
                (key == "lists" ? sweep.lists : sweep.each).emplace_back(parameter, values);
            }
        } else {
            errors.add(fmt::format("there is no key '{}' of that shape{}", key, did_you_mean(key, keys)));
        }
    }
    errors.throw_if_any(path.string());
    return sweep;
}

} // namespace bounce
