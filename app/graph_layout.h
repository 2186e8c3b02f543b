#pragma once
// Where the boxes and wires of a drawn graph lie: passes in layers from left to right, so that what a pass reads comes
// from further left, and long wires pass between the boxes. The method is that of Sugiyama, Tagawa and Toda 1981:
// layers, order within them by means of neighbours, then heights.

#include "graph/model.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

/// A pass. Lengths are in em, the font's size; y grows downward.
struct LayoutBox {
    std::string id;
    int plan = -1;       ///< index into Plan::passes; −1: it is skipped
    std::string skipped; ///< why
    int layer = 0;       ///< column
    glm::vec2 min{0}, size{0};
    std::vector<std::string> outputs; ///< resources that it writes, each a row below its head
};

/// A resource on its way from a pass that writes it to one that reads it.
struct LayoutWire {
    std::string resource;
    int from = -1, output = -1, to = -1; ///< boxes, and a row of the first
    bool back = false;                   ///< what an earlier frame or step left: it runs below all boxes
    bool skipped = false;                ///< one of its ends is
    std::vector<glm::vec2> points;       ///< corners from the row's right end to the reader's left edge
};

struct GraphLayout {
    std::vector<LayoutBox> boxes; ///< in the order of pass_rows()
    std::vector<LayoutWire> wires;
    glm::vec2 size{0}; ///< from (0, 0)
};

inline constexpr float k_layout_head = 2.7f; ///< height of a box above its rows, em
inline constexpr float k_layout_row = 1.3f;  ///< height of a row

/// The middle of a row.
inline float layout_row_y(const LayoutBox& box, int output) {
    return box.min.y + k_layout_head + (float(output) + 0.5f) * k_layout_row;
}

/// Every pass of the model, or without those that are skipped. The same plan gives the same layout.
GraphLayout lay_out_graph(const GraphModel& model, const Plan& plan, const SceneFacts& facts, bool with_skipped = true);

} // namespace bounce
