// Shadow maps of all lights: one depth layer a view (spot and directional 1, point 6).
#include "graph/context.h"
#include "surface/shadow_views.h"

namespace bounce {

class ShadowMapsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("opaque", {"surface/shadow_map.vert", "surface/shadow_map_opaque.frag"});
        description.program("alpha_tested", {"surface/shadow_map.vert", "surface/shadow_map.frag"});
        description.constant("view_index");
        description.parameters.add("resolution", resolution_, {16, 8192}, "texels", "width and height of each map");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        int views = shadow_view_count(d);
        d.uses("opaque");
        d.uses("alpha_tested");
        d.creates("shadow.depth", ResourceKind::texture_2d_array, "depth32f",
                  {resolution_, resolution_, std::max(views, 1)});
        d.writes("shadow.depth", Usage::depth);
        d.creates_buffer("shadow.views", std::to_string(views), sizeof(ShadowView)).overwritten = true;
        d.writes("shadow.views", Usage::storage);
        d.repeat(0, views);
    }

    void execute(PassContext& c) override {
        if (c.iteration == 0) {
            std::vector<ShadowView> views = shadow_views(c, resolution_);
            c.buffer("shadow.views").update(0, views.size() * sizeof(ShadowView), views.data());
        }
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glEnable(GL_DEPTH_CLAMP); // what lies before the near plane still blocks
        Targets targets;
        targets.depth = "shadow.depth";
        targets.layer = c.iteration;
        c.set("view_index", c.iteration);
        auto tested = [&](int draw) {
            return c.materials()[c.draws()[size_t(draw)].material].alpha_mode != AlphaMode::opaque;
        };
        DrawOptions options;
        options.keep = [&](int draw) { return !tested(draw); };
        c.draw_scene("opaque", targets, options);
        if (c.fact(&SceneFacts::alpha_tested_materials) + c.fact(&SceneFacts::blended_materials) == 0) return;
        options.keep = tested;
        c.draw_scene("alpha_tested", targets, options);
    }

  private:
    int resolution_ = 2048;
};

BOUNCE_REGISTER_PASS("shadow_maps", ShadowMapsPass,
                     "depth from every light: spot, directional (fitted to the scene), point (six faces)")

} // namespace bounce
