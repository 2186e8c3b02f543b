#pragma once
// A shot file of what the window shows, so that a picture can be made again without the window.

#include "app/ui/panel_context.h"

#include <filesystem>

namespace bounce {

/// The shot as a person left it: camera or its path, lights, objects, environment, size, time. What a shot file cannot
/// hold (materials) is not in it: see unsaved_edits(). `folder`: where the file will lie, for relative names of scenes.
/// Throws Error.
std::string shot_text(const Session& session, const SceneBaseline& opened, const std::filesystem::path& folder);

/// Whether the picture is not that of the shot file any more: camera, lights, objects or environment were changed.
bool differs_from_shot(const Session& session, const SceneBaseline& opened);
/// How many lights, objects and materials are not as they were when the shot was opened.
size_t edited_lights(const Scene& scene, const SceneBaseline& opened);
size_t edited_objects(const Shot& shot, const SceneBaseline& opened);
size_t edited_materials(const Scene& scene, const SceneBaseline& opened);
/// Whether the camera's path is another one than when the shot was opened.
bool camera_path_edited(const Shot& shot, const SceneBaseline& opened);
/// What a shot file cannot hold of it, in words; empty when nothing.
std::string unsaved_edits(const Session& session, const SceneBaseline& opened);

/// Writes a new shot file into the capture folder and remembers it. Throws Error.
std::filesystem::path save_shot(PanelContext& context);

/// The same as assets/shots/NAME.json, where the list of shots has it. Throws Error also for a bad name and a file that
/// is there already.
std::filesystem::path save_shot_in_list(PanelContext& context, const std::string& name);

/// The command line that makes the picture without the window. Empty while it would not: then the shot must be saved
/// first.
std::string reproducing_command(const PanelContext& context);

} // namespace bounce
