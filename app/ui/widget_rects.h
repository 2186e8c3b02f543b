#pragma once
// Where named widgets lie in the window, and what the window shows, as a file: tests drive the real window by it.

#include "app/ui/panel_context.h"

#include <filesystem>
#include <string>

namespace bounce {

/// Remembers the rectangle of the widget that was drawn last under `name` ("tonemap.exposure"), for this frame. Costs
/// nothing unless a dump was asked for.
void note_widget(const std::string& name);
void note_rectangle(const std::string& name, float x0, float y0, float x1, float y1);

/// From now on every drawn frame is told to `file`, replaced as a whole each time:
/// {"drawn", "rendered", "widgets": {name: [x0, y0, x1, y1]}, "problems": […], "notice", "camera", …}.
void start_widget_dump(const std::filesystem::path& file);
void begin_widget_frame();
void end_widget_frame(const PanelContext& context);

} // namespace bounce
