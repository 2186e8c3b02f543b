#pragma once
// Opening shots, scenes and graphs from the window.

#include "app/ui/panel_context.h"

namespace bounce {

/// Remembers what the scene is like now, so that edits can be told and written.
SceneBaseline baseline_of(const Session& session);

/// These ask for it: it happens between frames, and an Error shows in the status bar while the old stays. What was
/// edited of the old one is kept until it is opened again; what is kept of the new one is there again (work.h).
void ask_for_shot(PanelContext& context, const std::string& name);
/// The values and switches that a person set go along where the new graph has them, and it is told which.
void ask_for_graph(PanelContext& context, const std::string& name);
/// The shot as it is in its file: what was edited is forgotten. Where that is more than the camera, a person is asked
/// first (discard_prompt.h).
void ask_for_shot_again(PanelContext& context);
/// The same without a question.
void read_shot_again(PanelContext& context);
/// A file by what it holds: a .gltf or .glb by its extension, a .json by its keys.
void ask_for_file(PanelContext& context, const std::string& path);

/// Names of the .json files of a folder of the assets ("shots", "graphs"), sorted.
std::vector<std::string> asset_names(const char* folder);

} // namespace bounce
