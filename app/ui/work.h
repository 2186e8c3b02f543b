#pragma once
// What a person has changed and not saved: of each shot its camera and its path, lights, objects, materials and
// surroundings, of each graph its values and switches. It outlives a switch to another shot or graph, the window, and a
// process that is killed (ui_state_file.h).

#include "app/ui/panel_context.h"

#include <set>
#include <string>
#include <vector>

namespace bounce {

/// The name under which the work on the session's shot, or graph, is kept: its file.
std::string shot_key(const Session& session);
std::string graph_key(const Session& session);

/// Remembers the present work on the shot and the graph in ui.window.work; where there is none, forgets it.
void keep_work(PanelContext& context);

/// What is edited of the shot, in words: "the camera, 1 light"; empty: nothing but the camera, which is soon put back.
std::string edits_of_shot(PanelContext& context);

/// Puts back what is kept of the shot, which was just opened. Returns in words what it is: "the camera, 1 light";
/// empty: nothing. What does not fit the shot any more is forgotten, and told as an error.
std::string restore_shot_work(PanelContext& context);
/// Likewise of the graph: values and switches, but those that `given` names ("id.parameter", "id") stay as they are.
std::string restore_graph_work(PanelContext& context, const std::set<std::string>& given);

/// "a, b, c and 4 more".
std::string few_of(const std::vector<std::string>& names);

} // namespace bounce
