#include "graph/model.h"

#include "core/error.h"
#include "core/paths.h"
#include "core/text.h"
#include "graph/expression.h"
#include "graph/model_values.h"
#include "graph/script_pass.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace bounce {

Program* PassNode::program(const std::string& name) const {
    for (const auto& program : programs) {
        if (program->name() == name) return program.get();
    }
    return nullptr;
}

/// What the pass itself binds the slot to; no resource if it binds none.
static BindEntry own_binding(const PassNode& node, const std::string& slot) {
    const auto& bindings = node.description->bindings;
    if (auto bound = bindings.find(slot); bound != bindings.end()) return {bound->second, "", "", false};
    for (const auto& program : node.programs) {
        for (const ShaderSlot& known : program->slots())
            if (known.name == slot && !known.from.empty()) return {known.from, known.from_mip, known.from_layer, false};
    }
    return {};
}

BindEntry PassNode::target_of(const std::string& slot) const {
    BindEntry target{slot, "", "", false};
    std::set<std::string> seen;
    while (seen.insert(target.resource).second) {
        if (auto bound = entry.bind.find(target.resource); bound != entry.bind.end()) {
            if (seen.size() == 1) return bound->second;
            target.resource = bound->second.resource;
            break;
        }
        BindEntry next = own_binding(*this, target.resource);
        if (next.resource.empty()) break;
        // It follows what it names, if that is a slot of the pass, too.
        target.resource = next.resource;
        if (seen.size() == 1) target = next;
    }
    return target;
}

std::unique_ptr<Pass> make_pass(const NodeEntry& entry) {
    for (const PassType& known : pass_types()) {
        if (known.name != entry.type) continue;
        std::unique_ptr<Pass> pass = known.make();
        if (auto* script = dynamic_cast<ScriptPass*>(pass.get())) script->configure(entry);
        return pass;
    }
    throw Error("there is no pass type '" + entry.type + "'");
}

GraphModel::GraphModel(GraphFile file) : file_(std::move(file)) {
    ErrorList errors;
    graph_parameters_.declare_shader_parameter(rebuild_parameter());
    for (const ParameterInfo& info : file_.parameters) {
        if (info.name == k_rebuild) {
            errors.add("parameters: 'rebuild' is a parameter that every graph has: name this one otherwise");
            continue;
        }
        ParameterInfo declared = info;
        declared.in_shader = true; // no C++ member behind it
        graph_parameters_.declare_shader_parameter(declared);
    }
    for (const NodeEntry& entry : file_.nodes) {
        auto node = std::make_unique<PassNode>();
        node->entry = entry;
        node->enabled = entry.enabled;
        node->pass = make_pass(entry);
        node->description = std::make_unique<PassDescription>(node->parameters);
        node->pass->describe(*node->description);
        for (const ProgramEntry& program : node->description->programs) {
            node->programs.push_back(std::make_unique<Program>(program.name, program.stages, glsl_folder()));
        }
        if (!entry.params_of.empty() && !find_node(entry.params_of))
            errors.add(fmt::format("pass '{}': params_of names no earlier pass: '{}'", entry.id, entry.params_of));
        scan(*node);
        apply_file_values(*node, errors);
        scan_by_values(*node);
        nodes_.push_back(std::move(node));
    }
    for (const std::string& name : {file_.transport.occlusion_distance, file_.transport.occlusion_falloff}) {
        try {
            if (!name.empty()) parameter(name);
        } catch (const Error& error) {
            errors.add(std::string("transport: ") + error.what());
        }
    }
    errors.throw_if_any(file_.path.string());
}

PassNode* GraphModel::find_node(const std::string& id) const {
    for (const auto& node : nodes_) {
        if (node->id() == id) return node.get();
    }
    return nullptr;
}

Defines GraphModel::static_values(const PassNode& node) const {
    Defines values;
    const PassNode* shared = find_node(node.entry.params_of);
    for (const PassNode* of : {&node, shared}) { // what is shared wins
        if (!of) continue;
        for (const Parameter& parameter : of->parameters.all())
            if (parameter.info.is_static) values[parameter.info.name] = static_literal(parameter.info, parameter.value);
    }
    return values;
}

/// The values of a pass's own enumerations by name, for its shaders: "averaging_sum". Those of //! lines the shader's
/// text names by itself (gpu/shader_source.h).
static Defines choices_of(const PassNode& node) {
    Defines names;
    for (const Parameter& parameter : node.parameters.all()) {
        if (parameter.info.in_shader || parameter.info.kind != ParameterKind::enumeration) continue;
        for (size_t i = 0; i < parameter.info.choices.size(); ++i)
            names[parameter.info.name + "_" + parameter.info.choices[i]] = std::to_string(i);
    }
    return names;
}

void GraphModel::scan(PassNode& node, const Defines& formats) {
    std::vector<std::string> names;
    const PassNode* shared = find_node(node.entry.params_of);
    Defines defines = choices_of(node);
    defines.insert(formats.begin(), formats.end());
    // The first time what is there is declared, and the file's values follow.
    const std::vector<Parameter>& before = node.parameters.all();
    const bool again = std::any_of(before.begin(), before.end(), [](const Parameter& p) { return p.info.in_shader; });
    bool compiled_in = false; // a value that came back
    for (const auto& program : node.programs) {
        program->scan(defines, static_values(node));
        for (const ParameterInfo& info : program->parameters()) {
            if (shared && shared->parameters.find(info.name)) continue;
            const bool comes_back = again && !node.parameters.find(info.name);
            node.parameters.declare_shader_parameter(info);
            names.push_back(info.name);
            // What is compiled in may take a parameter away and bring it back: then with the file's value. What is
            // wrong with that was told when the file was read.
            const auto given = node.entry.params_json.find(info.name);
            try {
                if (comes_back && given != node.entry.params_json.end()) {
                    apply_file_value(node, info.name, given->second);
                    compiled_in = compiled_in || info.is_static;
                }
            } catch (const Error&) {
            }
        }
    }
    // A file that cannot be read for the moment must not cost the values of its parameters.
    bool broken = std::any_of(node.programs.begin(), node.programs.end(), [](auto& p) { return !p->errors().empty(); });
    if (!broken) node.parameters.keep_shader_parameters(names);
    if (compiled_in) scan(node, formats);
}

/// What is compiled in tells which slots there are: after it changed, they are read again.
void GraphModel::scan_by_values(PassNode& node) {
    if (!static_values(node).empty()) scan(node);
}

/// A graph file's value may be an expression over the graph's own parameters: "=resolution / 2".
static std::optional<std::string> as_expression(const std::string& json_text) {
    if (!json_text.starts_with("\"=")) return std::nullopt;
    return nlohmann::json::parse(json_text).get<std::string>().substr(1);
}

static std::optional<double> number_of(const Parameter* parameter) {
    if (!parameter) return std::nullopt;
    if (const auto* f = std::get_if<float>(&parameter->value)) return *f;
    if (const auto* i = std::get_if<int>(&parameter->value)) return *i;
    if (const auto* b = std::get_if<bool>(&parameter->value)) return *b ? 1 : 0;
    return std::nullopt;
}

static const Parameter* graph_parameter(const ParameterSet& parameters, const std::string& name) {
    return parameters.find(name.starts_with("graph.") ? name.substr(6) : name);
}

/// What a value of the graph file may be computed from: the graph's own parameters.
static Names graph_names(const ParameterSet& parameters) {
    Names names([&parameters](const std::string& name) { return number_of(graph_parameter(parameters, name)); });
    names.choices = [&parameters](const std::string& name) {
        const Parameter* found = graph_parameter(parameters, name);
        return found && found->info.kind == ParameterKind::enumeration ? &found->info.choices : nullptr;
    };
    names.known = [&parameters] {
        std::vector<std::string> known;
        for (const std::string& name : parameters.names())
            known.push_back("graph." + name);
        return known;
    };
    return names;
}

const Parameter* GraphModel::find_number(const std::string& name) const {
    if (const Parameter* own = graph_parameter(graph_parameters_, name)) return own;
    size_t dot = name.find('.');
    const PassNode* node = dot == std::string::npos ? nullptr : find_node(name.substr(0, dot));
    return node ? parameter_of(*node, name.substr(dot + 1)) : nullptr;
}

std::optional<double> GraphModel::number(const std::string& name) const {
    const Parameter* found = find_number(name);
    if (noting_ && found) note_number(name);
    return number_of(found);
}

const std::vector<std::string>* GraphModel::choices(const std::string& name) const {
    const Parameter* found = find_number(name);
    return found && found->info.kind == ParameterKind::enumeration ? &found->info.choices : nullptr;
}

/// By the names that a person sets: a pass's name may stand for a parameter of another pass (params_of).
void GraphModel::note_number(const std::string& name) const {
    const PassNode* node = find_node(name.substr(0, name.find('.')));
    if (!node || graph_parameter(graph_parameters_, name)) {
        noted_.insert(name.starts_with("graph.") ? name : "graph." + name);
        return;
    }
    noted_.insert(name);
    if (!node->entry.params_of.empty()) noted_.insert(node->entry.params_of + name.substr(name.find('.')));
}

std::set<std::string> GraphModel::note_numbers(bool on) const {
    noting_ = on;
    return std::exchange(noted_, {});
}

/// The text of a value that follows the graph's parameters. An enumeration is followed by name, not by number.
static std::string derived_text(const std::string& expression, const ParameterSet& graph) {
    const Parameter* followed = graph_parameter(graph, std::string(trim(expression)));
    if (followed && followed->info.kind == ParameterKind::enumeration) return to_text(followed->info, followed->value);
    return fmt::format("{}", evaluate(expression, graph_names(graph)));
}

void GraphModel::apply_file_value(PassNode& node, const std::string& name, const std::string& text) {
    if (auto expression = as_expression(text)) {
        node.parameters.set_text(name, derived_text(*expression, graph_parameters_), ParameterOrigin::graph);
    } else {
        node.parameters.set_json(name, nlohmann::json::parse(text), ParameterOrigin::graph);
    }
}

void GraphModel::apply_file_values(PassNode& node, ErrorList& errors) {
    for (const auto& [name, text] : node.entry.params_json) {
        try {
            apply_file_value(node, name, text);
        } catch (const Error& error) {
            // A parameter of a shader that does not scan for the moment is not unknown, only out of sight.
            bool broken =
                std::any_of(node.programs.begin(), node.programs.end(), [](auto& p) { return !p->errors().empty(); });
            if (!broken || node.parameters.find(name))
                errors.add(fmt::format("pass '{}': {}", node.id(), error.what()));
        }
    }
}

static std::pair<std::string, std::string> split_name(const std::string& name) {
    size_t dot = name.find('.');
    if (dot == std::string::npos) throw Error("'" + name + "' names no parameter: it is written pass.parameter");
    return {name.substr(0, dot), name.substr(dot + 1)};
}

Parameter& GraphModel::parameter(const std::string& name) {
    if (name.find('.') == std::string::npos) {
        for (const std::string& full : parameter_names()) {
            if (full.ends_with("." + name))
                throw Error(fmt::format("'{}' names no parameter: it is written pass.parameter (did you mean '{}'?)",
                                        name, full));
        }
    }
    split_name(name);
    const Parameter* found = find_parameter(name);
    if (!found)
        throw Error(fmt::format("there is no parameter '{}' in graph '{}'{}", name, file_.name,
                                did_you_mean(name, parameter_names())));
    return *const_cast<Parameter*>(found);
}

const Parameter* GraphModel::find_parameter(const std::string& name) const {
    size_t dot = name.find('.');
    if (dot == std::string::npos) return nullptr;
    std::string id = name.substr(0, dot), own = name.substr(dot + 1);
    if (id == "graph") return graph_parameters_.find(own);
    const PassNode* node = find_node(id);
    return node ? node->parameters.find(own) : nullptr;
}

const Parameter& GraphModel::parameter(const std::string& name) const {
    return const_cast<GraphModel*>(this)->parameter(name);
}

const Parameter* GraphModel::parameter_of(const PassNode& node, const std::string& name) const {
    if (const Parameter* own = node.parameters.find(name)) return own;
    const PassNode* shared = find_node(node.entry.params_of);
    return shared ? shared->parameters.find(name) : nullptr;
}

void GraphModel::set(const std::string& name, const std::string& text, ParameterOrigin origin) {
    parameter(name); // reports an unknown name with the nearest of the whole graph
    auto [id, own] = split_name(name);
    (id == "graph" ? graph_parameters_ : find_node(id)->parameters).set_text(own, text, origin);
    follow_change(name);
}

/// What must follow a parameter whose value has changed.
void GraphModel::follow_change(const std::string& name) {
    auto [id, own] = split_name(name);
    changes_.insert(name);
    auto scan_again = [&](const PassNode& changed) { // other slots may be there now
        for (const auto& node : nodes_)
            if (node.get() == &changed || node->entry.params_of == changed.id()) scan(*node);
    };
    if (id != "graph") {
        PassNode& owner = *find_node(id);
        if (!owner.parameters.find(own)->info.in_shader) owner.pass->reset_capacity();
        if (owner.parameters.find(own)->info.is_static) scan_again(owner);
        return;
    }
    // Values that the file derives from the graph's parameters follow, unless a person has set them.
    for (const auto& node : nodes_) {
        for (const auto& [derived, json] : node->entry.params_json) {
            Parameter* target = node->parameters.find(derived);
            auto expression = as_expression(json);
            if (!target || !expression || target->origin > ParameterOrigin::graph) continue;
            node->parameters.set_text(derived, derived_text(*expression, graph_parameters_), ParameterOrigin::graph);
            changes_.insert(node->id() + "." + derived);
            if (!target->info.in_shader) node->pass->reset_capacity();
            if (target->info.is_static) scan_again(*node);
        }
    }
}

bool GraphModel::has_auto(bool open) const {
    const auto any = [open](const ParameterSet& set) {
        return std::any_of(set.all().begin(), set.all().end(),
                           [open](const Parameter& p) { return p.is_auto && !(open && !p.reason.empty()); });
    };
    return any(graph_parameters_) ||
           std::any_of(nodes_.begin(), nodes_.end(), [&](auto& n) { return any(n->parameters); });
}

void GraphModel::resolve_auto(const SceneNeeds& needs) {
    const auto resolve = [&](const std::string& id, ParameterSet& set) {
        for (const std::string& name : set.names()) {
            const Parameter* p = set.find(name);
            if (!p || !p->is_auto) continue; // scanning again may have dropped it
            const auto need = needs.find(p->info.automatic);
            if (need == needs.end()) continue;
            const ParameterValue before = p->value;
            set.resolve(name, need->second.value, need->second.reason);
            if (set.find(name)->value != before) follow_change(id + "." + name);
        }
    };
    resolve("graph", graph_parameters_);
    for (const auto& node : nodes_)
        resolve(node->id(), node->parameters);
}

std::vector<std::string> GraphModel::parameter_names() const {
    std::vector<std::string> names;
    for (const Parameter& p : graph_parameters_.all())
        names.push_back("graph." + p.info.name);
    for (const auto& node : nodes_) {
        for (const Parameter& p : node->parameters.all())
            names.push_back(node->id() + "." + p.info.name);
    }
    return names;
}

std::vector<std::filesystem::path> GraphModel::files() const {
    std::vector<std::filesystem::path> files = file_.files;
    for (const auto& node : nodes_) {
        for (const auto& program : node->programs) {
            for (const auto& file : program->files()) {
                if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
            }
        }
    }
    return files;
}

void GraphModel::adopt_programs(GraphModel& other) {
    for (const auto& node : nodes_) {
        PassNode* before = other.find_node(node->id());
        if (!before || before->entry.type != node->entry.type) continue;
        for (auto& program : node->programs) {
            for (auto& compiled : before->programs) {
                bool same = compiled->name() == program->name() && compiled->stages() == program->stages();
                if (same) std::swap(program, compiled);
            }
        }
        scan(*node);
    }
}

} // namespace bounce
