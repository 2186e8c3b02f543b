#pragma once
// Passes on and off, as a step that can be undone.

#include "app/ui/panel_context.h"

namespace bounce {

/// With a pass come on those that make what it reads. What the graph cannot run without stays, and it is told why.
void switch_pass(PanelContext& context, const std::string& id, bool on);

} // namespace bounce
