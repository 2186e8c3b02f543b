#pragma once
// The triangles of all draws in a row: where each draw's begin, for shaders that give every triangle an invocation
// (glsl/lib/draw_of_triangle.glsl).

#include "graph/context.h"

namespace bounce {

/// The pass makes the slot's buffer: an entry a draw, one more at the end.
ResourceDeclaration& declare_draw_starts(Declaration& declaration, const std::string& slot);
struct DrawStarts {
    int draws = 0, triangles = 0;
};
/// Fills it with this frame's draws. `has`: whether a draw's triangles count; else it has none.
DrawStarts write_draw_starts(PassContext& context, const std::string& slot,
                             const std::function<bool(const GpuDraw&)>& has = {});

} // namespace bounce
