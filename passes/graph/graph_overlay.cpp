// Finding the files of a chain, and applying one overlay to a whole graph.
#include "graph/graph_overlay.h"

#include "core/error.h"
#include "core/json_text.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace bounce {

namespace fs = std::filesystem;

/// Files that extend one another: far more than a person can follow, and few enough to go through at once.
static constexpr size_t k_max_chain = 32;

OrderedJson parse_graph_text(const fs::path& path) {
    return read_json_file<OrderedJson>(path);
}

// --- finding ---------------------------------------------------------------------------------------------------------

static bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

static std::vector<std::string> names_of_graphs() {
    std::vector<std::string> names;
    std::error_code ignored;
    fs::path folder = assets_folder() / "graphs";
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().lexically_relative(folder).replace_extension().generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

fs::path find_base_graph(const std::string& name, const fs::path& extending) {
    std::optional<fs::path> itself;
    std::error_code ignored; // a name that is too long is no file's
    for (const fs::path& folder : {extending.parent_path(), assets_folder() / "graphs"}) {
        for (const fs::path& file : {folder / (name + ".json"), folder / name}) {
            if (name.empty() || !fs::is_regular_file(file, ignored)) continue;
            if (!is_same_file(file, extending)) return file;
            itself = file; // "dvs" beside the assets may extend the assets' "dvs"
        }
    }
    if (itself) return *itself;
    throw Error("there is no graph '" + shortened(name) + "' to extend" + did_you_mean(name, names_of_graphs()));
}

std::string extends_name(const fs::path& base, const fs::path& from) {
    std::error_code ignored;
    fs::path target = fs::weakly_canonical(base, ignored), file = fs::weakly_canonical(from, ignored);
    for (const fs::path& folder : {fs::weakly_canonical(assets_folder() / "graphs", ignored), file.parent_path()}) {
        fs::path name = target.lexically_relative(folder).replace_extension();
        if (name.empty() || *name.begin() == "..") continue;
        if (is_same_file(find_base_graph(name.generic_string(), from), base)) return name.generic_string();
    }
    fs::path relative = target.lexically_relative(file.parent_path());
    return (relative.empty() ? target : relative).generic_string();
}

/// What the file extends; nothing when that is no text.
static std::optional<std::string> base_of(const OrderedJson& layer) {
    auto extends = layer.is_object() ? layer.find("extends") : layer.end();
    if (!layer.is_object() || extends == layer.end() || !extends->is_string()) return std::nullopt;
    return extends->get<std::string>();
}

std::vector<fs::path> graph_chain(const fs::path& path) {
    std::vector<fs::path> files = {path};
    try {
        while (auto base = base_of(parse_graph_text(files.back()))) {
            fs::path next = find_base_graph(*base, files.back());
            bool known = std::any_of(files.begin(), files.end(), [&](auto& file) { return is_same_file(file, next); });
            if (known || files.size() == k_max_chain) break;
            files.push_back(next);
        }
    } catch (const std::exception&) {
        // As far as they can be found.
    }
    return files;
}

// --- applying --------------------------------------------------------------------------------------------------------

std::string pass_id(const OrderedJson& entry) {
    for (const char* key : {"id", "type"}) {
        auto found = entry.is_object() ? entry.find(key) : entry.end();
        if (entry.is_object() && found != entry.end() && found->is_string()) return found->get<std::string>();
    }
    return "";
}

namespace {

std::vector<std::string> keys_of(const OrderedJson& object) {
    std::vector<std::string> keys;
    if (!object.is_object()) return keys;
    for (const auto& [key, value] : object.items())
        keys.push_back(key);
    return keys;
}

class OverlayReader {
  public:
    OverlayReader(WholeGraph& graph, std::string file, ErrorList& errors)
        : graph_(graph), root_(graph.root), file_(std::move(file)), errors_(errors) {}

    void apply(const OrderedJson& overlay) {
        const std::vector<std::string> known = {"version",    "extends",   "about",  "transport",
                                                "parameters", "resources", "passes", "remove"};
        for (const auto& [key, value] : overlay.items()) {
            if (std::find(known.begin(), known.end(), key) == known.end())
                error("", fmt::format("there is no key '{}'{}", shortened(key), did_you_mean(key, known)));
            else if (key == "about")
                root_[key] = value;
            else if (key == "transport")
                change_fields(root_[key], value, key, {});
        }
        if (overlay.value("version", OrderedJson()) != 1) error("", "'version' must be 1");
        for (const char* key : {"parameters", "resources"})
            if (auto found = overlay.find(key); found != overlay.end()) change_named(key, *found);
        if (auto found = overlay.find("remove"); found != overlay.end()) remove_passes(*found);
        if (auto found = overlay.find("passes"); found != overlay.end()) change_passes(*found);
    }

  private:
    void error(const std::string& where, const std::string& message) {
        errors_.add(file_ + ": " + (where.empty() ? "" : where + ": ") + message);
    }

    /// Members take the place of those there; null takes one away. Members that `nested` names are joined the same way.
    void change_fields(OrderedJson& target, const OrderedJson& changes, const std::string& where,
                       const std::vector<std::string>& nested) {
        if (target.is_null()) target = OrderedJson::object();
        if (!changes.is_object() || !target.is_object()) return error(where, "must be an object {…}");
        for (const auto& [key, value] : changes.items()) {
            if (value.is_null() && !target.contains(key))
                error(where, fmt::format("there is no '{}' to take away{}", shortened(key),
                                         did_you_mean(key, keys_of(target))));
            else if (value.is_null())
                target.erase(key);
            else if (std::find(nested.begin(), nested.end(), key) != nested.end())
                change_fields(target[key], value, where + "." + key, {});
            else
                target[key] = value;
        }
    }

    /// Parameters or resources, by name.
    void change_named(const std::string& kind, const OrderedJson& changes) {
        OrderedJson& all = root_[kind];
        if (all.is_null()) all = OrderedJson::object();
        if (!changes.is_object() || !all.is_object()) return error(kind, "must be an object {…}");
        for (const auto& [name, value] : changes.items()) {
            graph_.origins[kind + "." + name] = file_;
            if (value.is_object() && all.contains(name))
                change_fields(all[name], value, kind + "." + name, {});
            else
                change_fields(all, OrderedJson{{name, value}}, kind, {});
        }
    }

    std::vector<std::string> ids() const {
        std::vector<std::string> ids;
        for (const OrderedJson& entry : root_["passes"])
            ids.push_back(pass_id(entry));
        return ids;
    }
    std::optional<size_t> find(const std::string& id) const {
        const OrderedJson& passes = root_["passes"];
        auto found = std::find_if(passes.begin(), passes.end(), [&](auto& entry) { return pass_id(entry) == id; });
        return found == passes.end() ? std::nullopt : std::optional(size_t(found - passes.begin()));
    }

    void remove_passes(const OrderedJson& list) {
        if (!list.is_array()) return error("remove", "must be a list of pass ids");
        for (const OrderedJson& value : list) {
            std::string id = value.is_string() ? value.get<std::string>() : value.dump();
            if (auto at = find(id))
                root_["passes"].erase(*at);
            else
                error("remove", fmt::format("there is no pass '{}'{}", shortened(id), did_you_mean(id, ids())));
        }
    }

    /// Where an entry asks to stand: the index of the pass before which it goes. An entry that does not ask follows the
    /// one before it in this file; the first goes to the end.
    std::optional<size_t> place_of(const std::string& where, const OrderedJson* before, const OrderedJson* after) {
        if (before && after) error(where, "takes 'before' or 'after', not both");
        const OrderedJson* asked = before ? before : after;
        if (!asked) {
            auto previous = find(previous_);
            return previous ? *previous + 1 : root_["passes"].size();
        }
        std::string id = asked->is_string() ? asked->get<std::string>() : asked->dump();
        auto at = find(id);
        if (!at) {
            error(where, fmt::format("'{}' names no pass: '{}'{}", before ? "before" : "after", shortened(id),
                                     did_you_mean(id, ids())));
            return std::nullopt;
        }
        return before ? *at : *at + 1;
    }

    void change_passes(const OrderedJson& list) {
        if (!list.is_array()) return error("passes", "must be a list");
        for (size_t i = 0; i < list.size(); ++i) {
            if (list[i].is_object())
                change_pass(list[i], pass_id(list[i]), i);
            else
                error(fmt::format("passes[{}]", i), "must be an object {…}");
        }
    }

    void change_pass(OrderedJson entry, const std::string& id, size_t i) {
        std::string where = id.empty() ? fmt::format("passes[{}]", i) : fmt::format("pass '{}'", shortened(id));
        std::optional<OrderedJson> before, after;
        for (auto [key, value] : {std::pair("before", &before), std::pair("after", &after)}) {
            if (entry.contains(key)) *value = entry[key];
            entry.erase(key);
        }
        auto known = find(id);
        if (!known && !entry.contains("type"))
            return error(where,
                         "there is no such pass to change" + did_you_mean(id, ids()) + "; a new one has a 'type'");
        if (known && entry.contains("type"))
            return error(where, "is there already: leave out 'type' to change it, or remove it first");
        graph_.origins["passes." + id] = file_;
        if (known) {
            entry.erase("id");
            change_fields(root_["passes"][*known], entry, where, {"params", "bind"});
            entry = root_["passes"][*known];
        }
        if (!known || before || after) {
            if (known) root_["passes"].erase(*known); // it moves
            auto place = place_of(where, before ? &*before : nullptr, after ? &*after : nullptr);
            root_["passes"].insert(root_["passes"].begin() + long(place.value_or(root_["passes"].size())), entry);
        }
        previous_ = id;
    }

    WholeGraph& graph_;
    OrderedJson& root_;
    std::string file_;
    ErrorList& errors_;
    std::string previous_; ///< the id of the entry before, in this file
};

void expand(const fs::path& path, WholeGraph& graph) {
    graph.files.push_back(path);
    OrderedJson layer = parse_graph_text(path);
    std::string file = path.filename().string();
    if (!layer.is_object() || !layer.contains("extends")) {
        graph.root = std::move(layer);
        return;
    }
    auto name = base_of(layer);
    if (!name) throw Error(path.string() + ": 'extends' must be the name of a graph, or a path");
    fs::path base;
    try {
        base = find_base_graph(*name, path);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", path.string(), error.what()));
    }
    auto in_chain = [&](const fs::path& known) { return is_same_file(known, base); };
    if (std::any_of(graph.files.begin(), graph.files.end(), in_chain)) {
        std::vector<std::string> names;
        for (const fs::path& known : graph.files)
            names.push_back(known.filename().string());
        names.push_back(base.filename().string());
        throw Error(fmt::format("{}: graphs extend each other in a circle: {}", path.string(), join(names, " → ")));
    }
    if (graph.files.size() == k_max_chain)
        throw Error(fmt::format("{}: more than {} graphs extend one another", path.string(), k_max_chain));
    expand(base, graph);
    apply_overlay(graph, layer, file);
}

} // namespace

void apply_overlay(WholeGraph& graph, const OrderedJson& overlay, const std::string& file) {
    ErrorList errors;
    if (!graph.root.is_object()) throw Error("what " + file + " extends is no graph: it must be an object {…}");
    OrderedJson& passes = graph.root["passes"];
    if (passes.is_null()) passes = OrderedJson::array();
    if (!passes.is_array()) throw Error("what " + file + " extends is no graph: 'passes' must be a list");
    OverlayReader(graph, file, errors).apply(overlay);
    errors.throw_if_any("graph '" + fs::path(file).stem().string() + "'");
}

WholeGraph expand_graph(const fs::path& path) {
    WholeGraph graph;
    expand(path, graph);
    return graph;
}

} // namespace bounce
