#pragma once
// One click to each thing that can be looked at inside the graph, and what it is that is looked at.

#include "app/ui/layout.h"
#include "app/ui/panel_context.h"

namespace bounce {

/// Asks for a resource in the viewport; "" is the final picture. `pass`: that draws it; it is switched on with what it
/// reads, and off again when something else is looked at. Between two frames.
void ask_for_view(PanelContext& context, const std::string& resource, const std::string& pass);

/// A button in the viewport's corner that opens the list of views, those of this graph first.
void draw_views_menu(PanelContext& context, const Area& area);

/// Colour bar with its values and unit, and in words what is shown. Nothing over the final picture. Draws into the
/// current window.
void draw_legend(PanelContext& context, const Area& area, const ViewerSettings& shown);

} // namespace bounce
