// Reflective shadow maps of all lights (Dachsbacher & Stamminger 2005): what each light sees, and what it sends on.
#include "graph/context.h"
#include "surface/shadow_views.h"

namespace bounce {

class RsmPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("draw", {"surface/rsm.vert", "surface/rsm.frag"});
        description.constant("view_index");
        description.constant("light_index");
        description.parameters.add("resolution", resolution_, {16, 8192}, "texels", "width and height of each map");
        description.parameters.follow_need("resolution", "map_texels");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        using enum ResourceKind;
        int views = shadow_view_count(d);
        d.uses("draw");
        auto target = [&](const char* name, const char* format, Usage usage) {
            d.creates(name, texture_2d_array, format, {resolution_, resolution_, std::max(views, 1)});
            d.writes(name, usage);
        };
        target("rsm.radiance", "rgba16f", Usage::colour);
        target("rsm.normal", "rgba16f", Usage::colour);
        target("rsm.depth", "depth32f", Usage::depth);
        d.creates_buffer("rsm.views", std::to_string(views), sizeof(ShadowView)).overwritten = true;
        d.writes("rsm.views", Usage::storage);
        d.repeat(0, views);
    }

    void execute(PassContext& c) override {
        if (c.iteration == 0) {
            std::vector<ShadowView> views = shadow_views(c, resolution_);
            c.buffer("rsm.views").update(0, views.size() * sizeof(ShadowView), views.data());
        }
        const std::vector<GpuLight>& lights = c.lights();
        int light = 0;
        while (light + 1 < int(lights.size()) && lights[size_t(light) + 1].shadow_base <= c.iteration)
            ++light;
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glEnable(GL_DEPTH_CLAMP); // what lies before the near plane is lit too
        Targets targets{{"rsm.radiance", "rsm.normal"}, "rsm.depth"};
        targets.layer = c.iteration;
        c.set("view_index", c.iteration);
        c.set("light_index", light);
        c.draw_scene("draw", targets);
    }

  private:
    int resolution_ = 1024;
};

BOUNCE_REGISTER_PASS("rsm", RsmPass,
                     "reflective shadow maps: the light that each texel's surface sends on, its normal and depth")

} // namespace bounce
