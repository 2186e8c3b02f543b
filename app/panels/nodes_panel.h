#pragma once
// The graph as boxes and wires: what of it stays from frame to frame.

#include "app/graph_layout.h"
#include "app/ui/texture_view.h"

namespace bounce {

struct NodesState {
    const GraphModel* model = nullptr; ///< that it was laid out for,
    uint64_t plans = ~0ull;            ///< and Graph::plans() then
    GraphLayout layout;
    float zoom = 1;
    glm::vec2 centre{0};  ///< what is in the panel's middle, em
    bool skipped = true;  ///< those passes are shown, too
    bool whole = true;    ///< zoom and centre follow the panel, so that all is seen
    float moved = 0;      ///< by the present press, pixels: a click moves nothing
    std::string pictured; ///< resource of the thumbnail
    uint64_t pictured_frame = ~0ull;
    std::unique_ptr<TextureView> thumbnail;
};

} // namespace bounce
