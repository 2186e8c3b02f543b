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

/// Sets values and asks for a new frame; what is refused is told by ui.say. Returns success.
bool apply(Session& session, UiState& ui, const std::vector<ParameterText>& values);

/// One step of undo from `before` to `after`, which has been applied already.
void push_undo(PanelContext& context, const std::string& what, const std::vector<ParameterText>& before,
               const std::vector<ParameterText>& after);

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
