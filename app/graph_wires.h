#pragma once
// Who gives what to whom in a graph: the boxes of a drawn graph, without their places, and its wires, without corners.

#include "app/graph_layout.h"

namespace bounce {

/// Boxes with their rows, and the wires between them. A wire that is not `back` goes to a later box.
GraphLayout connect_graph(const GraphModel& model, const Plan& plan, const SceneFacts& facts, bool with_skipped);

} // namespace bounce
