// A view of the photons that arrive: their footprints over the scene.
#include "graph/context.h"

namespace bounce {

class ViewFootprintsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("footprints", {"ldm/view_footprints.vert", "ldm/view_footprints.frag"});
        description.constant("background");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no lights";
    }

    void declare(Declaration& d) override {
        d.creates("debug.footprints", ResourceKind::texture_2d, "rgba16f", {});
        d.reads("photons.commands", Usage::indirect);
        d.uses("footprints");
        d.reads_and_writes("debug.footprints", Usage::colour);
    }

    void execute(PassContext& c) override {
        Targets picture{{"debug.footprints"}, ""};
        if (c.iteration == 0) {
            c.set("background", true);
            c.draw_arrays("footprints", picture, GL_TRIANGLE_STRIP, 4);
        }
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        c.set("background", false);
        c.draw_arrays_indirect("footprints", picture, GL_TRIANGLE_STRIP, "photons.commands");
    }
};

BOUNCE_REGISTER_PASS("view_footprints", ViewFootprintsPass, "photons' footprints as ellipses over the scene")

} // namespace bounce
