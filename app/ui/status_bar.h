#pragma once
// One line at the bottom: the renderer, what a frame costs, the notice, shader errors.

#include "app/ui/layout.h"
#include "app/ui/panel_context.h"
#include "gpu/capabilities.h"

namespace bounce {

void draw_status_bar(PanelContext& context, const Area& area, const Capabilities& capabilities);

} // namespace bounce
