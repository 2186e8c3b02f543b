#pragma once
// A graph as a picture of boxes and wires.

#include "app/graph_layout.h"

namespace bounce {

/// A whole SVG file: what passes read and write, and why some are skipped, is in the boxes' titles.
std::string graph_svg(const GraphModel& model, const Plan& plan, const SceneFacts& facts);

} // namespace bounce
