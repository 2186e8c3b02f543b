// Reflective shadow maps (Dachsbacher & Stamminger 2005): what each light sees, and what it sends on. Or what the
// environment lights: parallel light from a few directions over the sphere, each with what comes from around it.
#include "graph/context.h"
#include "surface/shadow_views.h"

#include <algorithm>
#include <cmath>

namespace bounce {

class RsmPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("draw", {"surface/rsm.vert", "surface/rsm.frag"});
        description.program("directions", {"surface/environment_directions.comp"});
        description.constant("view_index");
        description.constant("light_index");
        description.parameters.add("resolution", resolution_, {16, 8192}, "texels", "width and height of each map");
        description.parameters.follow_need("resolution", "map_texels");
        description.parameters.add_choice("of", of_, {"lights", "environment"}, "whose light the maps show");
        description.parameters.add("directions", directions_, {1, 32}, "",
                                   "of environment: maps, over the whole sphere");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        if (of_ == Of::environment) return facts.environment ? "" : "the scene has no environment";
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        using enum ResourceKind;
        int views = of_ == Of::environment ? directions_ : shadow_view_count(d);
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
        if (of_ == Of::environment) {
            d.uses("directions");
            d.creates_buffer("rsm.parallel", std::to_string(views), sizeof(glm::vec4)).overwritten = true;
            d.writes("rsm.parallel", Usage::storage);
        }
        d.repeat(0, views);
    }

    void execute(PassContext& c) override {
        int light = -1; // the environment
        if (of_ == Of::lights) {
            const std::vector<GpuLight>& lights = c.lights();
            light = 0;
            while (light + 1 < int(lights.size()) && lights[size_t(light) + 1].shadow_base <= c.iteration)
                ++light;
        }
        if (c.iteration == 0) {
            std::vector<ShadowView> views =
                of_ == Of::lights
                    ? shadow_views(c, resolution_)
                    : shadow_views(parallel_lights(), c.fact(&SceneFacts::bounds_over_animation), resolution_);
            c.buffer("rsm.views").update(0, views.size() * sizeof(ShadowView), views.data());
            if (of_ == Of::environment) {
                c.dispatch("directions", {directions_, 1, 1});
                c.barrier();
            }
        }
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
    enum class Of { lights, environment };
    /// Over a spherical Fibonacci lattice.
    std::vector<Light> parallel_lights() const {
        std::vector<Light> lights(size_t(directions_), Light{});
        for (int i = 0; i < directions_; ++i) {
            float y = 1 - (2 * float(i) + 1) / float(directions_), turn = 2.39996323f * float(i);
            float aside = std::sqrt(std::max(1 - y * y, 0.0f));
            lights[size_t(i)].type = LightType::directional;
            lights[size_t(i)].direction = -glm::vec3(aside * std::cos(turn), y, aside * std::sin(turn));
        }
        return lights;
    }

    int resolution_ = 1024, directions_ = 12;
    Of of_ = Of::lights;
};

BOUNCE_REGISTER_PASS("rsm", RsmPass,
                     "reflective shadow maps: the light that each texel's surface sends on, its normal and depth")

} // namespace bounce
