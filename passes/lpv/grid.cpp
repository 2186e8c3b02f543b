// Where the cells lie (LPV, section 4): one grid that holds the scene, or nested ones that go with the camera.
#include "lpv/grid.h"

#include "lpv/cell_sort.h"
#include "voxel/voxel_grid.h"

#include <cmath>

namespace bounce {

LpvGrid lpv_grid(const LpvPlacement& placement, const Bounds& scene, glm::vec3 position, glm::vec3 forward) {
    const VoxelGrid whole(scene, placement.cells);
    LpvGrid grid;
    grid.cells = placement.cells;
    grid.cascades = placement.cascades;
    grid.follows = placement.follow ? 1 : 0;
    float cell = whole.voxel_size() * (placement.follow ? placement.extent : 1);
    for (int k = placement.cascades - 1; k >= 0; --k, cell *= 0.5f) {
        LpvCascade& cascade = grid.cascade[k];
        cascade.anchor = whole.origin;
        cascade.cell = cell;
        if (k + 1 == placement.cascades && !placement.follow) continue; // cell 0 lies at the anchor
        const float half = 0.5f * float(placement.cells);
        const glm::vec3 middle = position + forward * (placement.ahead * half * cell);
        cascade.base = glm::ivec3(glm::floor((middle - cascade.anchor) / cell - half + 0.5f));
    }
    return grid;
}

class LpvGridPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        ParameterSet& p = description.parameters;
        p.add("follow", placement_.follow, "the last cascade follows the camera too; off: it holds the scene");
        p.add("extent", placement_.extent, {0.01f, 4}, "",
              "follow: the last cascade's width as a share of the scene's longest side");
        p.add("ahead", placement_.ahead, {0, 1}, "",
              "how far before the camera middles lie, as a share of half their width");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        d.creates_buffer("lpv.grid", "1", sizeof(LpvGrid)).overwritten = true;
        d.writes("lpv.grid", Usage::storage);
    }

    void execute(PassContext& c) override {
        placement_.cells = lpv_cells(c);
        placement_.cascades = lpv_cascades(c);
        glm::vec3 position(0), forward(0, 0, -1);
        if (placement_.follow || placement_.cascades > 1) { // else it does not depend on the camera
            position = c.frame(&FrameConstants::camera_position);
            forward = c.frame(&FrameConstants::camera_forward);
        }
        const LpvGrid grid = lpv_grid(placement_, c.fact(&SceneFacts::bounds_over_animation), position, forward);
        c.buffer("lpv.grid").update(0, sizeof(grid), &grid);
    }

  private:
    LpvPlacement placement_;
};

BOUNCE_REGISTER_PASS("lpv_grid", LpvGridPass, "light propagation volumes: where the cells of all cascades lie")

} // namespace bounce
