#include "app/listing.h"

#include "core/asset_files.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/metric_table.h"
#include "core/paths.h"
#include "core/text.h"
#include "scene/find_scene.h"

#include <algorithm>

namespace bounce {

/// As commands take them: those of presets/ with the folder.
static std::vector<std::string> graph_names() {
    std::vector<std::string> names = asset_names("graphs");
    for (const std::string& name : asset_names("graphs/presets"))
        names.push_back("presets/" + name);
    std::sort(names.begin(), names.end());
    return names;
}

/// Graphs that are lists of departures from another of them (every method starts from one in graphs/base).
static std::vector<std::string> preset_names() {
    const std::vector<std::string> graphs = graph_names();
    std::vector<std::string> names;
    for (const std::string& name : graphs) {
        try {
            const auto json = read_json_file(assets_folder() / "graphs" / (name + ".json"));
            const auto base = json.is_object() ? json.value("extends", nlohmann::json()) : nlohmann::json();
            if (base.is_string() && std::find(graphs.begin(), graphs.end(), base.get<std::string>()) != graphs.end())
                names.push_back(name);
        } catch (const Error&) {
            // A file that cannot be read is told by who opens it.
        }
    }
    return names;
}

static std::vector<std::string> metric_names() {
    std::vector<std::string> names;
    for (const Metric& metric : metrics())
        names.push_back(metric.name);
    return names;
}

const std::vector<NameKind>& name_kinds() {
    static const std::vector<NameKind> kinds = {{"shots", [] { return asset_names("shots"); }},
                                                {"scenes", scene_names},
                                                {"graphs", graph_names},
                                                {"presets", preset_names},
                                                {"sweeps", [] { return asset_names("sweeps"); }},
                                                {"tables", [] { return asset_names("tables"); }},
                                                {"cases", [] { return asset_names("stability"); }},
                                                {"metrics", metric_names}};
    return kinds;
}

std::vector<std::string> names_of(const std::string& kind) {
    std::vector<std::string> known;
    for (const NameKind& entry : name_kinds()) {
        if (entry.name == kind) return entry.names();
        known.push_back(entry.name);
    }
    throw Error("there is no kind '" + kind + "'" + did_you_mean(kind, known));
}

} // namespace bounce
