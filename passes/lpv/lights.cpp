// Virtual point lights by cells (LPV, section 3.2): the texels of the reflective shadow maps, sorted by where their
// light starts.
#include "lpv/cell_sort.h"
#include "lpv/grid.h"

namespace bounce {

class LpvLightsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        describe_cell_sort(description, "lpv.light_pairs", "lpv/light_keys.comp", "lpv/arrange_lights.comp");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        const std::string texels = "rsm.depth.width * rsm.depth.height * rsm.depth.depth";
        d.creates_buffer("lpv.vpls", "graph.cascades * " + texels, sizeof(LpvVpl)).overwritten = true;
        d.creates_buffer("lpv.light_ranges", k_lpv_cells, 8);
        d.creates_buffer("lpv.counts", "4", 4);
        declare_cell_sort(d, texels);
        d.counts("lit texels of maps", "lpv.counts", 0);
        d.counts("lit texels outside of the grid", "lpv.counts", 1);
    }

    void execute(PassContext& c) override {
        const glm::ivec3 map = c.texture("rsm.depth").desc().size;
        const int side = lpv_cells(c);
        run_cell_sort(c, int64_t(map.x) * map.y * map.z, side * side * side);
    }
};

BOUNCE_REGISTER_PASS("lpv_lights", LpvLightsPass,
                     "virtual point lights: texels of reflective shadow maps, sorted by cells")

} // namespace bounce
