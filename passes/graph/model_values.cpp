// What a person set of a graph, taken out and put into another; and the parameter that every graph has.
#include "graph/model_values.h"

#include "core/error.h"
#include "graph/model.h"

namespace bounce {

ParameterInfo rebuild_parameter() {
    ParameterInfo info;
    info.name = k_rebuild;
    info.kind = ParameterKind::enumeration;
    info.default_value = int(Rebuild::every_frame);
    info.choices = {"every_frame", "on_change"};
    info.help = "on_change: a pass whose inputs have not changed does not run again";
    info.in_shader = true; // no C++ member behind it
    return info;
}

Rebuild GraphModel::rebuild() const {
    return Rebuild(std::get<int>(graph_parameters_.find(k_rebuild)->value));
}

void GraphModel::set_default_rebuild(Rebuild rebuild) {
    ParameterInfo info = rebuild_parameter();
    info.default_value = int(rebuild);
    graph_parameters_.declare_shader_parameter(info);
}

GraphValues GraphModel::values() const {
    GraphValues values;
    auto add = [&](const std::string& id, const std::string& owner, const ParameterSet& set) {
        for (const Parameter& p : set.all()) {
            if (p.origin < ParameterOrigin::command_line) continue;
            values.parameters.push_back({id + "." + p.info.name, owner, p.info.kind, p.text(), p.origin});
        }
    };
    add("graph", "graph", graph_parameters_);
    for (const auto& node : nodes_)
        add(node->id(), node->entry.type, node->parameters);
    for (const auto& node : nodes_)
        if (node->enabled != node->entry.enabled) values.switches.emplace_back(node->id(), node->enabled);
    values.asked = asked_;
    return values;
}

void GraphModel::adopt_values(const GraphValues& values) {
    for (const GraphValues::Value& value : values.parameters) {
        const PassNode* node = find_node(value.name.substr(0, value.name.find('.')));
        if ((node ? node->entry.type : "graph") != value.owner) continue;
        try {
            if (parameter(value.name).info.kind == value.kind) set(value.name, value.text, value.origin);
        } catch (const Error&) {
            // There is no such parameter here, or its range excludes the value: its own stands.
        }
    }
    for (const auto& [id, on] : values.switches)
        if (PassNode* node = find_node(id)) node->enabled = on;
    asked_.insert(values.asked.begin(), values.asked.end());
    for (const auto& node : nodes_)
        scan_by_values(*node);
}

std::string GraphValues::options() const {
    std::string text;
    auto add = [&](const std::string& option) { text += (text.empty() ? "" : " ") + option; };
    for (const Value& value : parameters)
        add("--set " + value.name + "=" + value.text);
    for (const auto& [id, on] : switches)
        add((on ? "--enable " : "--disable ") + id);
    return text;
}

} // namespace bounce
