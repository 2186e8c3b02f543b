#include "app/panels/parameter_edit.h"

#include "core/error.h"
#include "core/log.h"
#include "core/problem.h"
#include "core/text.h"
#include "graph/expression.h"
#include "graph/plan_memory.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace bounce {

ParameterText text_of(const std::string& id, const Parameter& parameter) {
    return {id + "." + parameter.info.name, parameter.text(), parameter.origin};
}

ParameterText home_of(const GraphModel& model, const std::string& id, const Parameter& parameter) {
    const ParameterInfo& info = parameter.info;
    ParameterText home{id + "." + info.name, info.default_text(), ParameterOrigin::default_value};
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
        const bool automatic = json.is_string() && json.get<std::string>() == k_auto && !info.automatic.empty();
        home.text = automatic ? k_auto : to_text(info, parse_value(info, json));
        home.origin = ParameterOrigin::graph;
    } catch (const std::exception&) {
        // The shader's range has changed since the file was read: the default stands.
    }
    return home;
}

bool shapes_plan(const Graph& graph, const std::string& name, const Parameter& parameter) {
    const ParameterInfo& info = parameter.info;
    return !info.in_shader || info.is_static || name.starts_with("graph.") || graph.plan().numbers.contains(name);
}

std::string plan_refusal(Session& session) {
    GraphModel& model = session.graph().model();
    try {
        Plan plan = model.plan(session.facts(), session.size());
        check_plan_fits(model, session.facts(), plan, session.graph().plan().total_bytes());
    } catch (const std::exception& problem) {
        return problem_text(problem);
    }
    return {};
}

/// Sets what can be set; returns what was there before.
static std::vector<ParameterText> set_all(Session& session, const std::vector<ParameterText>& values,
                                          ErrorList& errors) {
    std::vector<ParameterText> before;
    for (const ParameterText& value : values) {
        try {
            const std::string id = value.name.substr(0, value.name.find('.'));
            before.push_back(text_of(id, session.graph().model().parameter(value.name)));
            session.set_parameter(value.name, value.text, value.origin);
        } catch (const Error& error) {
            errors.add(error.what());
        }
    }
    return before;
}

bool apply(Session& session, UiState& ui, const std::vector<ParameterText>& values) {
    if (ui.mid_frame) {
        ui.redraw();
        for (const ParameterText& value : values)
            ui.waiting_values[value.name] = value.text;
        ui.change_graph([&session, &ui, values] {
            ui.waiting_values.clear();
            apply(session, ui, values);
        });
        return true;
    }
    const GraphModel& model = session.graph().model();
    const bool shapes = std::any_of(values.begin(), values.end(), [&](const ParameterText& value) {
        const Parameter* parameter = model.find_parameter(value.name);
        return parameter && shapes_plan(session.graph(), value.name, *parameter);
    });
    ErrorList errors, ignored;
    const std::vector<ParameterText> before = set_all(session, values, errors);
    if (std::string why = shapes ? plan_refusal(session) : ""; !why.empty()) {
        set_all(session, before, ignored);
        if (plan_refusal(session).empty())
            errors.add(fmt::format("{}: {} stays {}", why, before.front().name, before.front().text));
        else
            set_all(session, values, ignored); // it was wrong before: this may be one of several steps to mend it
    }
    ui.redraw();
    if (errors.empty()) return true;
    const std::string text = join(errors.messages(), "; ");
    spdlog::error("{}", text);
    ui.say(text, true);
    return false;
}

void push_undo(PanelContext& context, const std::string& what, const std::vector<ParameterText>& before,
               const std::vector<ParameterText>& after) {
    Session& session = context.session;
    UiState& ui = context.ui;
    context.undo.push({what, [&session, &ui, before] { apply(session, ui, before); },
                       [&session, &ui, after] { apply(session, ui, after); }});
}

void finish_edit(PanelContext& context) {
    const ParameterEdit edit = std::exchange(context.ui.edit, {});
    const Parameter* parameter = context.session.graph().model().find_parameter(edit.name);
    if (!parameter || parameter->value.index() != edit.value.index()) return;
    const ParameterText after{edit.name, to_text(parameter->info, edit.value), ParameterOrigin::panel};
    if (after.text == edit.before || (edit.waits && !apply(context.session, context.ui, {after}))) return;
    push_undo(context, edit.name, {{edit.name, edit.before, edit.origin}}, {after});
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
    if (after.empty() || !apply(context.session, context.ui, after)) return;
    push_undo(context, names.size() == 1 ? "reset " + names.front() : "reset all", before, after);
}

} // namespace bounce
