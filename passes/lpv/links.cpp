// Which links between neighbouring cells surfaces cross: what blocks light exactly, from triangles instead of surfels.
#include "graph/draw_starts.h"
#include "lpv/cell_sort.h"

#include <algorithm>

namespace bounce {

class LpvLinksPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("links", {"lpv/links.comp"});
        description.constant("resolution_of_grid");
        description.constant("cascade_index");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        d.creates_buffer("lpv.links", k_lpv_cells, 4);
        declare_draw_starts(d, "voxels.draw_starts");
        d.uses("links");
    }

    void execute(PassContext& c) override {
        constexpr int k_lanes = 16, k_row = 65536; // as in glsl/voxel/triangle_voxels.glsl
        const int triangles = write_draw_starts(c, "voxels.draw_starts").triangles;
        c.set("resolution_of_grid", lpv_cells(c));
        for (int cascade = 0; cascade < lpv_cascades(c); ++cascade) {
            if (cascade > 0) c.barrier();
            c.set("cascade_index", cascade);
            c.dispatch("links", {std::min(triangles, k_row) * k_lanes, (triangles + k_row - 1) / k_row, 1});
        }
    }
};

BOUNCE_REGISTER_PASS("lpv_links", LpvLinksPass, "which links between the centres of cells the scene's triangles cross")

} // namespace bounce
