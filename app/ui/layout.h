#pragma once
// Where things are in the window: a column on each side, the viewport between them, a row of panels under it, a status
// bar.

#include "app/ui/window_state.h"

#include <imgui.h>

namespace bounce {

inline constexpr const char* k_picture_window = "##viewport";

struct Area {
    ImVec2 min{0, 0}, size{0, 0};
    bool visible() const { return size.x > 0 && size.y > 0; }
};

struct Areas {
    Area left, upper_right, lower_right, viewport, bottom, status;
};

/// Areas for a window of `display` screen coordinates. What does not fit shrinks: the viewport keeps a third.
Areas arrange(const LayoutState& layout, ImVec2 display, float scale);

/// The bars between areas, which can be dragged. Returns true while one is.
bool drag_splitters(LayoutState& layout, const Areas& areas, float scale);

/// Begins a fixed window that fills the area.
bool begin_area(const char* name, const Area& area, ImGuiWindowFlags flags = 0);

/// The current window, a small one over the picture, stays there when the picture is clicked.
void keep_over_picture();

} // namespace bounce
