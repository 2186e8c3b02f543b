#pragma once
// Changing parameters so that it can be undone.

#include "app/panels/panel.h"

#include <string>
#include <vector>

namespace bounce {

/// A parameter's value as text, and who set it.
struct ParameterText {
    std::string name; ///< "direct.normal_offset"
    std::string text;
    ParameterOrigin origin = ParameterOrigin::default_value;
};

ParameterText text_of(const std::string& id, const Parameter& parameter);

/// What a parameter goes back to: the graph file's value where it gives one, else the default.
ParameterText home_of(const GraphModel& model, const std::string& id, const Parameter& parameter);

/// Sets values and asks for a new frame. What is refused is told once by ui.say, and the value before stands: one out
/// of range, or all of them when the graph has no plan with them. Returns success. Wants a current context. While a
/// frame is rendered, they wait for its end (ui.waiting_values) and count as set.
bool apply(Session& session, UiState& ui, const std::vector<ParameterText>& values);

/// Whether the graph is planned or a shader compiled again when it changes: sizes, what is compiled in, what other
/// values are computed from. Others only feed a uniform.
bool shapes_plan(const Graph& graph, const std::string& name, const Parameter& parameter);
/// Why the graph cannot run as it is set now; empty: it can. Wants a current context.
std::string plan_refusal(Session& session);

/// One step of undo from `before` to `after`, which has been applied already.
void push_undo(PanelContext& context, const std::string& what, const std::vector<ParameterText>& before,
               const std::vector<ParameterText>& after);

/// Ends ui.edit: applies its value where that waited for the end, and makes it one step of undo. Nothing where there is
/// no edit.
void finish_edit(PanelContext& context);

/// Puts parameters back to home_of(), as one step.
void reset_parameters(PanelContext& context, const std::vector<std::string>& names);

/// Every parameter of the graph with the id of its pass, the graph's own ("graph") first.
struct NamedParameter {
    std::string id;
    const Parameter* parameter;
    std::string name() const { return id + "." + parameter->info.name; }
};
std::vector<NamedParameter> all_parameters(const GraphModel& model);

} // namespace bounce
