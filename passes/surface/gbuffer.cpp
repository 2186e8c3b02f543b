// The G-buffer: what the camera sees, one surface a pixel. Everything later reads from it.
#include "graph/context.h"

namespace bounce {

class GbufferPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("draw", {"surface/gbuffer.vert", "surface/gbuffer.frag"});
        description.parameters.add("cull_back_faces", cull_back_faces_,
                                   "skips back faces of materials that are not double-sided");
        description.parameters.add("motion", motion_, "also how far each surface moved since the last frame");
    }

    void declare(Declaration& d) override {
        using enum ResourceKind;
        d.uses("draw");
        auto target = [&](const char* name, const char* format) {
            d.creates(name, texture_2d, format, {});
            d.writes(name, Usage::colour);
        };
        target("gbuffer.albedo", "rgba16f");
        target("gbuffer.normal", "rgba16f");
        target("gbuffer.geometric_normal", "rgba16f");
        target("gbuffer.roughness_metallic", "rg16");
        moves_ = motion_ && d.fact(&SceneFacts::dynamic_instances) > 0;
        // The shader's outputs are numbered, so that the last one needs the one before it.
        emission_ = d.fact(&SceneFacts::emissive_materials) > 0 || moves_;
        if (emission_) target("gbuffer.emission", "rgba16f");
        if (moves_) target("gbuffer.motion", "rgba16f");
        d.creates("gbuffer.depth", texture_2d, "depth32f", {});
        d.writes("gbuffer.depth", Usage::depth);
    }

    void execute(PassContext& c) override {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER); // reversed depth
        Targets targets{{"gbuffer.albedo", "gbuffer.normal", "gbuffer.geometric_normal", "gbuffer.roughness_metallic"},
                        "gbuffer.depth"};
        if (emission_) targets.colours.push_back("gbuffer.emission");
        if (moves_) targets.colours.push_back("gbuffer.motion");
        DrawOptions options;
        options.cull_back_faces = cull_back_faces_;
        options.y_turned = true;
        c.draw_scene("draw", targets, options);
    }

  private:
    bool cull_back_faces_ = false;
    bool motion_ = false;
    bool emission_ = false, moves_ = false; // which targets there are
};

BOUNCE_REGISTER_PASS("gbuffer", GbufferPass,
                     "what the camera sees: base colour, normals, roughness and metallic, emission, depth")

} // namespace bounce
