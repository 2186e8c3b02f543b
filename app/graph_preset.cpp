#include "app/graph_preset.h"

#include "core/error.h"
#include "core/image.h"
#include "core/json_edit.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "graph/graph_overlay.h"
#include "graph/model_values.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

namespace {

/// The shortest text of a value, as graph files hold it.
OrderedJson value_json(const Parameter& parameter) {
    return OrderedJson::parse(to_json(parameter.info, parameter.value).dump());
}

/// What the file gives to the parameter, if anything.
const OrderedJson* given(const OrderedJson& entry, const std::string& name) {
    auto params = entry.find("params");
    if (params == entry.end() || !params->contains(name)) return nullptr;
    return &(*params)[name];
}

/// Whether the panel's value is what the file makes of the parameter.
bool is_as_in_file(const Parameter& parameter) {
    return parameter.origin <= ParameterOrigin::graph;
}

/// A whole graph with the values and switches of the panels.
OrderedJson with_panel_values(OrderedJson root, const GraphModel& model) {
    for (const Parameter& parameter : model.graph_parameters().all()) {
        if (parameter.info.name == k_rebuild || is_as_in_file(parameter)) continue; // how it is run, not what it is
        root.at("parameters").at(parameter.info.name)["default"] = value_json(parameter);
    }
    for (OrderedJson& entry : root.at("passes")) {
        const PassNode* node = model.find_node(pass_id(entry));
        if (!node) continue;
        for (const Parameter& parameter : node->parameters.all()) {
            if (is_as_in_file(parameter)) continue;
            // The default need not be written, unless the file says something else.
            bool is_default = parameter.value == parameter.info.default_value;
            if (!is_default || given(entry, parameter.info.name))
                entry["params"][parameter.info.name] = value_json(parameter);
        }
        if (node->enabled != entry.value("enabled", true)) entry["enabled"] = node->enabled;
    }
    return root;
}

/// Writes what an overlay says into the text of a file that has the same passes or extends them.
std::string edited(const fs::path& file, const OrderedJson& overlay) {
    JsonEdit text(read_file(file));
    OrderedJson own = parse_graph_text(file);
    const OrderedJson parameters = overlay.value("parameters", OrderedJson::object()); // items() keeps no copy
    for (const auto& [name, fields] : parameters.items())
        text.set({"parameters", name, "default"}, fields.at("default").dump());
    OrderedJson passes = own.value("passes", OrderedJson::array());
    size_t count = passes.size();
    for (const OrderedJson& entry : overlay.value("passes", OrderedJson::array())) {
        auto same = [&](const OrderedJson& known) { return pass_id(known) == pass_id(entry); };
        size_t at = size_t(std::find_if(passes.begin(), passes.end(), same) - passes.begin());
        if (at == passes.size()) {
            text.insert({"passes"}, count++, on_one_line(entry));
            continue;
        }
        for (const auto& [key, value] : entry.items()) {
            if (key == "enabled") text.set({"passes", std::to_string(at), key}, value.dump());
            if (key != "params") continue;
            for (const auto& [name, setting] : value.items())
                text.set({"passes", std::to_string(at), key, name}, on_one_line(setting));
        }
    }
    return text.text();
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

} // namespace

std::string graph_preset_text(const Session& session, const fs::path& path, const std::string& about) {
    const GraphModel& model = session.graph().model();
    const fs::path& file = model.file().path;
    const auto& chain = model.file().files;
    bool is_own = is_same_file(path, file);
    if (!is_own && std::any_of(chain.begin(), chain.end(), [&](auto& base) { return is_same_file(base, path); }))
        throw Error(fmt::format("invalid preset '{}': the loaded graph extends it; take another name", path.string()));
    try {
        OrderedJson whole = expand_graph(file).root;
        OrderedJson departures = graph_departures(whole, with_panel_values(whole, model));
        if (is_own) return edited(file, departures);
        OrderedJson root = {{"version", 1}, {"extends", extends_name(file, path)}};
        root["about"] = about.empty() ? "Values set in the window over " + model.file().name + "." : about;
        root.update(departures);
        return graph_text(root);
    } catch (const OrderedJson::exception& error) {
        throw Error("'" + file.string() + "' is not the graph that was loaded any more: " + error.what());
    }
}

OrderedJson graph_as_set(const Session& session) {
    const GraphModel& model = session.graph().model();
    try {
        return with_panel_values(expand_graph(model.file().path).root, model);
    } catch (const OrderedJson::exception& error) {
        throw Error("'" + model.file().path.string() + "' is not the graph that was loaded any more: " + error.what());
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
    write_file_atomically(path, graph_preset_text(session, path));
    return path;
}

} // namespace bounce
