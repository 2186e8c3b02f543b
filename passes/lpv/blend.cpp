// Injection as published (LPV, section 3.2): the texels of the reflective shadow maps as points, blended into their
// cells.
#include "lpv/cell_sort.h"

#include <glad/gl.h>

namespace bounce {

class LpvBlendPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("blend", {"lpv/blend.vert", "lpv/blend.frag"});
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        d.uses("blend");
        for (const char* target : {"lpv.blended_red", "lpv.blended_green", "lpv.blended_blue"}) {
            d.creates(target, ResourceKind::texture_2d, "rgba16f",
                      Extent("graph.cells ^ 2", "graph.cells * graph.cascades"));
            d.reads_and_writes(target, Usage::colour);
        }
    }

    void execute(PassContext& c) override {
        const glm::ivec3 map = c.texture("rsm.depth").desc().size;
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        c.draw_arrays("blend", {{"lpv.blended_red", "lpv.blended_green", "lpv.blended_blue"}, ""}, GL_POINTS,
                      map.x * map.y * map.z * lpv_cascades(c));
    }
};

BOUNCE_REGISTER_PASS("lpv_blend", LpvBlendPass,
                     "virtual point lights blended into cells, as published, instead of sorted by them")

} // namespace bounce
