// Virtual point lights (Ritschel et al. 2008, section 3): texels of the reflective shadow maps, drawn by what they send
// on.
#include "graph/context.h"
#include "graph/prefix_sum.h"
#include "ism/vpl.h"
#include "surface/shadow_views.h"

#include <algorithm>
#include <bit>

namespace bounce {

class IsmVplsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("weights", {"ism/weights.comp"});
        description.program("draw", {"ism/draw.comp"});
        describe_prefix_sum(description, "ism.places");
        description.constant("weight_stage");
        description.constant("vpl_count");
        description.parameters.add("vpls", vpls_, {1, 65536}, "", "virtual point lights of all lights together");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        d.creates_buffer("ism.vpls", std::to_string(vpls_), sizeof(Vpl)).overwritten = true;
        d.creates_buffer("ism.totals", "4", 4);
        declare_prefix_sum(d, "4 ^ ceil(log2(max(rsm.depth.width, rsm.depth.height))) * rsm.depth.depth");
        d.uses("weights");
        d.uses("draw");
    }

    void execute(PassContext& c) override {
        glm::ivec3 map = c.texture("rsm.depth").desc().size;
        map.x = map.y = int(std::bit_ceil(unsigned(std::max(map.x, map.y)))); // as in glsl/ism/texel_order.glsl
        for (int stage : {0, 1, 2}) {
            c.set("weight_stage", stage);
            c.dispatch("weights", map);
            c.barrier();
        }
        run_prefix_sum(c, int64_t(map.x) * map.y * map.z);
        c.set("vpl_count", vpls_);
        c.dispatch("draw", {vpls_, 1, 1});
    }

  private:
    int vpls_ = 1024;
};

BOUNCE_REGISTER_PASS("ism_vpls", IsmVplsPass,
                     "virtual point lights: texels of reflective shadow maps, drawn in proportion to their flux")

} // namespace bounce
