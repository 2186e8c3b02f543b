#pragma once
// Why is it dark? A line over the picture when the graph leaves out light that the shot has, and a button to a graph
// that has it.

#include "app/ui/layout.h"
#include "app/ui/panel_context.h"

namespace bounce {

/// What the picture lacks, in words: light that the graph scatters nowhere (app/omitted_light.h), parts that nothing
/// makes because their pass is skipped, a shot without any light. Empty: nothing.
std::string missing_light(const Session& session);
/// A graph of the assets that leaves out nothing of it; empty: there is none.
std::string graph_with_all_light(const Session& session);

/// Over the lower edge of the picture's area.
void draw_light_banner(PanelContext& context, const Area& area);

} // namespace bounce
