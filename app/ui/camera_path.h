#pragma once
// A path of the camera through the bookmarks of the shot.

#include "app/ui/panel_context.h"

#include <vector>

namespace bounce {

/// Catmull-Rom through the cameras' positions and targets, `seconds` from one to the next, as the linear keys that
/// shots have: up to 24 for each part, at most one per frame. `start`: the time of the first key.
Path path_through(const std::vector<Camera>& cameras, const LoadedSpace& space, float start, float seconds, float fps);

/// The bookmarks of the session's shot, in order.
std::vector<Bookmark> bookmarks_of(const WindowState& window, const Session& session);

/// From the first frame on the camera follows a path through the shot's bookmarks, ui.window.path_seconds from one to
/// the next; up and field of view are those of the first. One step of undo. Fewer than two are refused, and told.
void make_camera_path(PanelContext& context);

/// Back to the camera, or the path, of the shot's file: one from bookmarks is dropped (one step of undo).
void go_to_shot_camera(PanelContext& context);

} // namespace bounce
