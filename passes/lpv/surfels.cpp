// Surfels by cells (LPV, section 3.4): what the reflective shadow maps and the camera see of surfaces, sorted by cells
// of the geometry volume.
#include "lpv/cell_sort.h"
#include "lpv/grid.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

class LpvSurfelsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        describe_cell_sort(description, "lpv.surfel_pairs", "lpv/surfel_keys.comp", "lpv/arrange_surfels.comp");
        description.constant("pixel_grid");
        description.parameters.add("pixel_rows", pixel_rows_, {0, 1024}, "",
                                   "rows of the G-buffer's pixels that become surfels; 0: the maps alone");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        const glm::ivec2 picture = d.picture_size();
        pixels_.y = std::min(pixel_rows_, picture.y);
        pixels_.x = pixels_.y > 0 ? std::max(1, (picture.x * pixels_.y + picture.y / 2) / picture.y) : 0;
        const std::string entries =
            fmt::format("rsm.depth.width * rsm.depth.height * rsm.depth.depth + {}", pixels_.x * pixels_.y);
        d.creates_buffer("lpv.surfels", "graph.cascades * (" + entries + ")", 16).overwritten = true;
        d.creates_buffer("lpv.surfel_ranges", "graph.cascades * (graph.cells + 1) ^ 3", 8);
        declare_cell_sort(d, entries);
    }

    void execute(PassContext& c) override {
        const glm::ivec3 map = c.texture("rsm.depth").desc().size;
        c.set("pixel_grid", pixels_);
        const int side = lpv_cells(c) + 1; // cells about the corners of the light's cells
        run_cell_sort(c, int64_t(map.x) * map.y * map.z + int64_t(pixels_.x) * pixels_.y, side * side * side);
    }

  private:
    int pixel_rows_ = 128;
    glm::ivec2 pixels_{0};
};

BOUNCE_REGISTER_PASS("lpv_surfels", LpvSurfelsPass,
                     "surfels of the geometry volume: what lights and camera see, sorted by cells")

} // namespace bounce
