#include "graph/graph_file.h"

#include "core/error.h"
#include "core/json_text.h"
#include "core/parameter_steps.h"
#include "core/paths.h"
#include "core/scanner.h"
#include "core/text.h"
#include "graph/graph_overlay.h"
#include "graph/pass.h"
#include "graph/scope.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace bounce {

using nlohmann::json;

namespace {

/// Reads one JSON object and reports what is wrong with it under a path like passes[2].bind.
class ObjectReader {
  public:
    ObjectReader(const json& object, std::string where, ErrorList& errors)
        : object_(object), where_(std::move(where)), errors_(errors) {
        if (!object.is_object()) error("must be an object {…}");
    }
    ~ObjectReader() {
        if (!object_.is_object()) return;
        for (const auto& [key, value] : object_.items()) {
            if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
                errors_.add(
                    fmt::format("{}: there is no key '{}'{}", where_, shortened(key), did_you_mean(key, known_)));
            }
        }
    }
    void error(const std::string& message) { errors_.add(where_ + ": " + message); }
    const json* get(const std::string& key) {
        known_.push_back(key);
        if (!object_.is_object()) return nullptr;
        auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }
    bool has(const std::string& key) const { return object_.is_object() && object_.contains(key); }
    std::string text(const std::string& key, const std::string& fallback = "") {
        const json* value = get(key);
        if (!value) return fallback;
        if (value->is_string()) return value->get<std::string>();
        error("'" + key + "' must be text");
        return fallback;
    }
    bool flag(const std::string& key, bool fallback) {
        const json* value = get(key);
        if (!value) return fallback;
        if (value->is_boolean()) return value->get<bool>();
        error("'" + key + "' must be true or false");
        return fallback;
    }
    /// A number or an expression, as text.
    std::string expression(const std::string& key, const std::string& fallback) {
        const json* value = get(key);
        return value ? expression_of(*value, key, fallback) : fallback;
    }
    std::string expression_of(const json& value, const std::string& key, const std::string& fallback) {
        if (value.is_string()) return value.get<std::string>();
        if (value.is_number()) return value.dump();
        error("'" + key + "' must be a number or an expression");
        return fallback;
    }
    const std::string& where() const { return where_; }

  private:
    const json& object_;
    std::string where_;
    ErrorList& errors_;
    std::vector<std::string> known_;
};

std::vector<std::string> numbers_of(const json& array) {
    std::vector<std::string> numbers;
    for (const json& number : array)
        numbers.push_back(number.dump());
    return numbers;
}

/// What a parameter is whose default is "auto", until a scene is there: in the middle of its limits, by factors. Their
/// type is its own.
ParameterValue before_a_scene(ParameterInfo& info, const json* range) {
    if (!(info.min > 0) || !std::isfinite(info.max))
        throw Error("a 'default' of \"auto\" needs a 'range' or 'choices' above 0");
    if (range && (*range)[0].is_number_integer() && (*range)[1].is_number_integer()) info.kind = ParameterKind::integer;
    return value_for(info, std::sqrt(info.min * info.max));
}

ParameterInfo read_parameter(const std::string& name, const json& value, const std::string& where, ErrorList& errors) {
    ObjectReader reader(value, where, errors);
    ParameterInfo info;
    info.name = name;
    info.unit = reader.text("unit");
    info.help = reader.text("help");
    info.automatic = reader.text("auto");
    const json* range = reader.get("range");
    const json* choices = reader.get("choices");
    const json* fallback = reader.get("default");
    // "auto" has no type of its own: its limits do.
    const bool is_auto = fallback && *fallback == k_auto && !info.automatic.empty();
    const bool named = choices && choices->is_array() &&
                       std::any_of(choices->begin(), choices->end(), [](const json& c) { return !c.is_number(); });
    if (named) {
        info.kind = ParameterKind::enumeration;
        for (const json& choice : *choices)
            info.choices.push_back(choice.is_string() ? choice.get<std::string>() : choice.dump());
    } else if (fallback && fallback->is_boolean()) {
        info.kind = ParameterKind::boolean;
    } else if (fallback && fallback->is_number_integer()) {
        info.kind = ParameterKind::integer;
    } else if (fallback && fallback->is_array()) {
        info.kind = fallback->size() == 2   ? ParameterKind::vec2
                    : fallback->size() == 4 ? ParameterKind::vec4
                                            : ParameterKind::vec3;
    }
    if (range) {
        if (range->is_array() && range->size() == 2 && (*range)[0].is_number() && (*range)[1].is_number()) {
            info.min = (*range)[0].get<double>();
            info.max = (*range)[1].get<double>();
        } else {
            reader.error("'range' is written [least, greatest]");
        }
    }
    if (!fallback) {
        reader.error("'default' is missing");
        return info;
    }
    try {
        if (choices && choices->is_array() && !named) choose_from(info, numbers_of(*choices));
        info.auto_by_default = is_auto;
        info.default_value = is_auto ? before_a_scene(info, range) : parse_value(info, *fallback);
    } catch (const Error& error) {
        reader.error(error.what());
    }
    return info;
}

ResourceDeclaration read_resource(const std::string& name, const json& value, const std::string& where,
                                  std::vector<std::string>& fields, ErrorList& errors) {
    ObjectReader reader(value, where, errors);
    ResourceDeclaration resource;
    resource.name = name;
    resource.declared_by = "graph file";
    try {
        check_resource_name(name);
    } catch (const Error& error) {
        reader.error(error.what());
    }
    if (value.is_object()) {
        for (const auto& item : value.items())
            fields.push_back(item.key());
    }
    std::string kind = reader.text("kind", "texture_2d");
    const std::vector<std::string> kinds = {"texture_2d", "texture_2d_array", "texture_3d", "buffer"};
    auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end())
        reader.error("there is no kind '" + kind + "'" + did_you_mean(kind, kinds));
    else
        resource.kind = ResourceKind(found - kinds.begin());
    resource.format = reader.text("format", "rgba16f");
    if (resource.kind != ResourceKind::buffer) {
        try {
            format_by_name(resource.format);
        } catch (const Error& error) {
            reader.error(error.what());
        }
    }
    if (const json* size = reader.get("size")) {
        if (size->is_array() && size->size() >= 1 && size->size() <= 3) {
            resource.size = Extent(1, 1, 1);
            for (size_t i = 0; i < size->size(); ++i)
                resource.size.parts[i] = reader.expression_of((*size)[i], "size", "1");
        } else if (size->is_string()) {
            resource.size = Extent::relative_to(size->get<std::string>());
        } else if (size->is_object()) {
            ObjectReader relative(*size, reader.where() + ".size", errors);
            std::string of = relative.text("of");
            std::string scale = relative.expression("scale", "1");
            auto part = [&](const char* side) { return fmt::format("max(1, ceil({}.{} * ({})))", of, side, scale); };
            resource.size = Extent(part("width"), part("height"), of + ".depth");
        } else {
            reader.error("'size' is [x, y, z], the name of a resource, or {\"of\": resource, \"scale\": s}");
        }
    }
    resource.mips = reader.expression("mips", "1");
    resource.count = reader.expression("count", "0");
    resource.persistent = reader.flag("persistent", false);
    resource.overwritten = !reader.flag("clear", true);
    resource.radiance = reader.flag("radiance", holds_radiance(resource.name));
    if (const json* stride = reader.get("stride")) {
        if (stride->is_number_integer() && stride->get<int>() > 0)
            resource.stride = stride->get<int>();
        else
            reader.error("'stride' is a number of bytes above zero");
    }
    if (const json* neutral = reader.get("neutral")) {
        ParameterInfo info;
        info.name = "neutral";
        info.kind = ParameterKind::vec4;
        try {
            resource.neutral = std::get<glm::vec4>(parse_value(info, *neutral));
        } catch (const Error& error) {
            reader.error(error.what());
        }
    }
    return resource;
}

Transport read_transport(const json& value, ErrorList& errors) {
    ObjectReader reader(value, "transport", errors);
    Transport transport;
    transport.diffuse_only = reader.flag("diffuse_only", false);
    transport.diffuse_secondary = reader.flag("diffuse_secondary", false);
    if (const json* bounces = reader.get("bounces")) {
        bool whole = bounces->is_number_integer() && bounces->get<int>() >= 0;
        if (whole)
            transport.bounces = bounces->get<int>();
        else if (*bounces != "all")
            reader.error("'bounces' is a number of scattering orders after direct, or \"all\"");
    }
    if (const json* parts = reader.get("parts")) {
        transport.parts.clear();
        bool texts = parts->is_array() && !parts->empty();
        for (const json& part : *parts) {
            texts = texts && part.is_string();
            if (texts) transport.parts.push_back(part.get<std::string>());
        }
        if (!texts) reader.error("'parts' is a list of out.* names");
    }
    transport.occlusion_distance = reader.text("occlusion_distance");
    transport.occlusion_falloff = reader.text("occlusion_falloff");
    return transport;
}

BindEntry read_bind(const json& value, const std::string& where, ErrorList& errors) {
    BindEntry bind;
    if (value.is_string()) {
        bind.resource = value.get<std::string>();
    } else {
        ObjectReader reader(value, where, errors);
        bind.resource = reader.text("resource");
        bind.mip = reader.expression("mip", "");
        bind.layer = reader.expression("layer", "");
        if (bind.resource.empty()) reader.error("'resource' is missing");
    }
    Scanner scanner(bind.resource);
    if (scanner.take("previous(")) {
        auto inside = scanner.until(')');
        if (inside && scanner.at_end() && !trim(*inside).empty()) {
            bind.previous = true;
            bind.resource = std::string(trim(*inside));
        }
    }
    return bind;
}

RepeatEntry read_repeat(const json& value, ObjectReader& node, ErrorList& errors) {
    RepeatEntry repeat;
    if (!value.is_object()) {
        repeat.over = "count";
        repeat.count = node.expression_of(value, "repeat", "1");
        return repeat;
    }
    ObjectReader reader(value, node.where() + ".repeat", errors);
    const std::vector<std::string> kinds = {"count", "mips", "layers", "lights", "views", "bounces", "loop"};
    // A loop and nothing else: the steps of the pass that declares it.
    repeat.over = reader.text("over", value.size() == 1 && value.contains("loop") ? "loop" : "count");
    if (std::find(kinds.begin(), kinds.end(), repeat.over) == kinds.end()) {
        reader.error("nothing repeats over '" + repeat.over + "'" + did_you_mean(repeat.over, kinds));
    }
    if (repeat.over == "bounces") repeat.over = "count";
    repeat.of = reader.text("of");
    repeat.count = reader.expression("count", "1");
    repeat.from = reader.expression("from", "0");
    repeat.loop = reader.text("loop");
    if ((repeat.over == "mips" || repeat.over == "layers") && repeat.of.empty()) {
        reader.error("'of' is missing: the resource whose " + repeat.over + " are meant");
    }
    return repeat;
}

NodeEntry read_node(const json& value, const std::string& where, ErrorList& errors) {
    ObjectReader reader(value, where, errors);
    NodeEntry node;
    node.type = reader.text("type");
    node.id = reader.text("id", node.type);
    node.shader = reader.text("shader");
    node.enabled = reader.flag("enabled", true);
    node.params_of = reader.text("params_of");
    node.needs = reader.expression("needs", "");
    std::vector<std::string> types;
    for (const PassType& type : pass_types())
        types.push_back(type.name);
    if (node.type.empty())
        reader.error("'type' is missing" + did_you_mean("", types));
    else if (std::find(types.begin(), types.end(), node.type) == types.end()) {
        reader.error("there is no pass type '" + node.type + "'" + did_you_mean(node.type, types));
    }
    if (!node.id.empty() && !is_lower_case_name(node.id, true)) {
        reader.error("'" + shortened(node.id) + "' is no pass id: it is lower case, digits and underscores");
    }
    if (node.type == "compute" && node.shader.empty()) reader.error("'shader' is missing: a .comp file under glsl/");
    if (node.type != "compute" && !node.shader.empty()) reader.error("only passes of type compute take a 'shader'");
    if (const json* params = reader.get("params")) {
        if (params->is_object()) {
            for (const auto& [name, parameter] : params->items())
                node.params_json[name] = parameter.dump();
        } else {
            reader.error("'params' must be an object {name: value}");
        }
    }
    if (const json* bind = reader.get("bind")) {
        if (bind->is_object()) {
            for (const auto& [slot, target] : bind->items()) {
                node.bind[slot] = read_bind(target, where + ".bind." + slot, errors);
            }
        } else {
            reader.error("'bind' must be an object {slot: resource}");
        }
    }
    if (const json* dispatch = reader.get("dispatch")) {
        if (dispatch->is_string())
            node.dispatch.resource = dispatch->get<std::string>();
        else if (dispatch->is_array() && !dispatch->empty() && dispatch->size() <= 3) {
            for (const json& part : *dispatch)
                node.dispatch.threads.push_back(reader.expression_of(part, "dispatch", "1"));
        } else if (dispatch->is_object() && dispatch->contains("indirect") && (*dispatch)["indirect"].is_string()) {
            node.dispatch.indirect = (*dispatch)["indirect"].get<std::string>();
        } else {
            reader.error("'dispatch' is the name of a resource, [x, y, z] threads, or {\"indirect\": buffer}");
        }
    }
    if (const json* repeat = reader.get("repeat")) node.repeat = read_repeat(*repeat, reader, errors);
    return node;
}

} // namespace

std::filesystem::path find_graph(const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code ignored; // a name that is too long is no file's
    for (const fs::path& file :
         {fs::path(name), fs::path(name + ".json"), assets_folder() / "graphs" / (name + ".json")})
        if (!name.empty() && fs::is_regular_file(file, ignored)) return file;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(assets_folder() / "graphs", ignored)) {
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    throw Error("there is no graph '" + shortened(name) + "'" + did_you_mean(name, names));
}

namespace {

/// What the reader calls an entry in errors: with the file that said the last of it where there are several.
std::string place_of(const WholeGraph& graph, const std::string& where, const std::string& key) {
    auto origin = graph.origins.find(key);
    bool several = graph.files.size() > 1;
    std::string base = several ? graph.files.back().filename().string() : "";
    std::string file = origin != graph.origins.end() ? origin->second : base;
    return file.empty() ? where : file + ": " + where;
}

void read_members(const WholeGraph& graph, GraphFile& file, ErrorList& errors) {
    const json root = graph.root;
    ObjectReader reader(root, "graph", errors);
    file.about = reader.text("about");
    if (const json* transport = reader.get("transport")) file.transport = read_transport(*transport, errors);
    const json* version = reader.get("version");
    if (!version || *version != 1) reader.error("'version' must be 1");
    if (const json* parameters = reader.get("parameters"); parameters && parameters->is_object()) {
        for (const auto& [name, value] : parameters->items())
            file.parameters.push_back(
                read_parameter(name, value, place_of(graph, "parameters." + name, "parameters." + name), errors));
    } else if (parameters) {
        reader.error("'parameters' must be an object");
    }
    if (const json* resources = reader.get("resources"); resources && resources->is_object()) {
        for (const auto& [name, value] : resources->items())
            file.resources.push_back(read_resource(
                name, value, place_of(graph, "resources." + name, "resources." + name), file.set_fields[name], errors));
    } else if (resources) {
        reader.error("'resources' must be an object");
    }
    const json* passes = reader.get("passes");
    if (!passes || !passes->is_array() || passes->empty()) {
        reader.error("'passes' must be a list of at least one pass");
        return;
    }
    for (size_t i = 0; i < passes->size(); ++i) {
        std::string id = pass_id((*passes)[i]);
        std::string where = graph.files.size() > 1 && !id.empty() ? "pass '" + id + "'" : fmt::format("passes[{}]", i);
        file.nodes.push_back(read_node((*passes)[i], place_of(graph, where, "passes." + id), errors));
    }
}

/// Names that are taken.
void check_names(const GraphFile& file, ErrorList& errors) {
    std::set<std::string> ids;
    for (const NodeEntry& node : file.nodes) {
        if (!ids.insert(node.id).second) errors.add("two passes have the id '" + node.id + "'");
        if (node.id == "graph")
            errors.add("a pass cannot have the id 'graph': that name is the graph's own parameters");
    }
    std::vector<std::string> taken = scene_fact_names();
    taken.insert(taken.end(), {"width", "height", "iteration", "true", "false"});
    for (const ParameterInfo& parameter : file.parameters) {
        if (std::find(taken.begin(), taken.end(), parameter.name) != taken.end())
            errors.add(fmt::format("invalid parameter name '{}': expressions know that name already", parameter.name));
    }
}

} // namespace

GraphFile read_graph_file(const std::filesystem::path& path) {
    WholeGraph graph = expand_graph(path);
    GraphFile file;
    file.path = path;
    file.name = path.stem().string();
    file.files = graph.files;
    ErrorList errors;
    read_members(graph, file, errors);
    check_names(file, errors);
    errors.throw_if_any(path.string());
    return file;
}

} // namespace bounce
