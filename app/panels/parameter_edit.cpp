#include "app/panels/parameter_edit.h"

#include "core/error.h"
#include "core/text.h"
#include "graph/expression.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace bounce {

ParameterText text_of(const std::string& id, const Parameter& parameter) {
    return {id + "." + parameter.info.name, to_text(parameter.info, parameter.value), parameter.origin};
}

ParameterText home_of(const GraphModel& model, const std::string& id, const Parameter& parameter) {
    const ParameterInfo& info = parameter.info;
    ParameterText home{id + "." + info.name, to_text(info, info.default_value), ParameterOrigin::default_value};
    const PassNode* node = model.find_node(id);
    if (!node) return home;
    auto given = node->entry.params_json.find(info.name);
    if (given == node->entry.params_json.end()) return home;
    try {
        nlohmann::json json = nlohmann::json::parse(given->second);
        if (json.is_string() && json.get_ref<const std::string&>().starts_with("=")) {
            json = evaluate(json.get<std::string>().substr(1),
                            [&](const std::string& name) { return model.number(name); });
            if (info.kind == ParameterKind::boolean) json = json.get<double>() != 0;
        }
        home.text = to_text(info, parse_value(info, json));
        home.origin = ParameterOrigin::graph;
    } catch (const std::exception&) {
        // The shader's range has changed since the file was read: the default stands.
    }
    return home;
}

bool apply(Session& session, UiState& ui, const std::vector<ParameterText>& values) {
    ErrorList errors;
    for (const ParameterText& value : values) {
        try {
            session.set_parameter(value.name, value.text, value.origin);
        } catch (const Error& error) {
            errors.add(error.what());
        }
    }
    ui.redraw();
    if (!errors.empty()) ui.say(join(errors.messages(), "; "), true);
    return errors.empty();
}

void push_undo(PanelContext& context, const std::string& what, const std::vector<ParameterText>& before,
               const std::vector<ParameterText>& after) {
    Session& session = context.session;
    UiState& ui = context.ui;
    context.undo.push({what, [&session, &ui, before] { apply(session, ui, before); },
                       [&session, &ui, after] { apply(session, ui, after); }});
}

std::vector<NamedParameter> all_parameters(const GraphModel& model) {
    std::vector<NamedParameter> all;
    for (const Parameter& parameter : model.graph_parameters().all())
        all.push_back({"graph", &parameter});
    for (const auto& node : model.nodes()) {
        for (const Parameter& parameter : node->parameters.all())
            all.push_back({node->id(), &parameter});
    }
    return all;
}

void reset_parameters(PanelContext& context, const std::vector<std::string>& names) {
    const GraphModel& model = context.session.graph().model();
    std::vector<ParameterText> before, after;
    for (const NamedParameter& named : all_parameters(model)) {
        if (std::find(names.begin(), names.end(), named.name()) == names.end()) continue;
        before.push_back(text_of(named.id, *named.parameter));
        after.push_back(home_of(model, named.id, *named.parameter));
    }
    if (after.empty()) return;
    apply(context.session, context.ui, after);
    push_undo(context, names.size() == 1 ? "reset " + names.front() : "reset all", before, after);
}

} // namespace bounce
