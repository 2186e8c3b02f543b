#include "app/ui/graph_preset.h"

#include "core/error.h"
#include "core/image.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "graph/model_values.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace bounce {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

/// The shortest text of a value, as graph files hold it.
json value_json(const Parameter& parameter) {
    return json::parse(to_json(parameter.info, parameter.value).dump());
}

void set_params(json& entry, const PassNode& node) {
    json params = entry.value("params", json::object());
    for (const Parameter& parameter : node.parameters.all()) {
        const std::string& name = parameter.info.name;
        if (parameter.value == parameter.info.default_value)
            params.erase(name);
        else
            params[name] = value_json(parameter);
    }
    if (params.empty())
        entry.erase("params");
    else
        entry["params"] = params;
    if (node.enabled)
        entry.erase("enabled");
    else
        entry["enabled"] = false;
}

} // namespace

std::string graph_preset_text(const Session& session) {
    const GraphModel& model = session.graph().model();
    const fs::path& file = model.file().path;
    try {
        json root = json::parse(read_file(file), nullptr, true, true);
        for (const Parameter& parameter : model.graph_parameters().all()) {
            if (parameter.info.name == k_rebuild) continue; // how it is run, not what it is
            root.at("parameters").at(parameter.info.name)["default"] = value_json(parameter);
        }
        for (json& entry : root.at("passes")) {
            std::string id = entry.value("id", entry.value("type", std::string()));
            if (const PassNode* node = model.find_node(id)) set_params(entry, *node);
        }
        return root.dump(2) + "\n";
    } catch (const json::exception& error) {
        throw Error("'" + file.string() + "' is not the graph that was loaded any more: " + error.what());
    }
}

fs::path graph_preset_path(const std::string& name) {
    if (name.find('/') != std::string::npos) {
        fs::path path(name);
        if (path.extension() != ".json") path += ".json";
        return path;
    }
    std::string_view stem = name;
    if (stem.ends_with(".json")) stem.remove_suffix(5);
    auto good = [](char c) { return is_word_character(c) || c == '-'; };
    if (stem.empty() || stem.size() > k_max_name || !std::all_of(stem.begin(), stem.end(), good)) {
        throw Error("'" + shortened(name) +
                    "' is no name for a graph: it is letters, digits and underscores, or a path");
    }
    return assets_folder() / "graphs" / fs::path(name).replace_extension(".json");
}

fs::path save_graph_preset(const Session& session, const std::string& name, bool overwrite) {
    fs::path path = graph_preset_path(name);
    std::error_code ignored;
    if (fs::exists(path, ignored) && !overwrite)
        throw Error("'" + path.string() + "' is there already: tick 'overwrite', or take another name");
    write_file_atomically(path, graph_preset_text(session));
    return path;
}

} // namespace bounce
