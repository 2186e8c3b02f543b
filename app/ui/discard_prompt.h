#pragma once
// The question before edits of the shot are thrown away.

#include "app/ui/panel_context.h"

namespace bounce {

/// Nothing unless ui.window.discarding names edits. Enter throws them away, Escape keeps them.
void draw_discard_prompt(PanelContext& context);

} // namespace bounce
