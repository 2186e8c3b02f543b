// Photon splatting (LDM, section 4.2): every photon of a batch adds its light to the pixels under its footprint. By
// blending, as published, or by tiles in compute: each tile finds the photons that reach it, in their order, and adds
// them up without writing in between.
#include "graph/context.h"

#include <fmt/format.h>

namespace bounce {

class SplatPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("blend", {"ldm/splat.vert", "ldm/splat.frag"});
        description.program("boxes", {"ldm/splat_boxes.comp"});
        description.program("tiles", {"ldm/splat_tiles.comp"});
        description.parameters.add_choice("route", route_, {"blend", "tiles"},
                                          "blended quads as published, or compute by tiles of 16 × 16 pixels");
        description.parameters.add("scale", scale_, {0.125, 1}, "",
                                   "size of the picture that photons are splatted to, as a share of the picture");
        description.constant("splat_size");
    }

    void declare(Declaration& d) override {
        d.creates("photons.irradiance", ResourceKind::texture_2d, "rgba32f",
                  Extent(fmt::format("ceil(width * {})", scale_), fmt::format("ceil(height * {})", scale_)));
        d.reads("photons.commands", Usage::indirect);
        if (route_ == Route::blend) {
            d.uses("blend");
            d.reads_and_writes("photons.irradiance", Usage::colour);
        } else {
            d.creates_buffer("photons.boxes", "photons.stored.count", 8).overwritten = true;
            d.creates_buffer("photons.chunks", "ceil(photons.stored.count / 256)", 8).overwritten = true;
            d.uses("boxes");
            d.uses("tiles");
        }
    }

    void execute(PassContext& c) override {
        c.set("splat_size", glm::vec2(c.size("photons.irradiance")));
        if (route_ == Route::blend) {
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
            c.draw_arrays_indirect("blend", {{"photons.irradiance"}, ""}, GL_TRIANGLE_STRIP, "photons.commands");
            return;
        }
        c.dispatch_indirect("boxes", "photons.commands", 4 * sizeof(uint32_t));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        c.dispatch("tiles", c.size("photons.irradiance"));
    }

  private:
    enum class Route { blend, tiles };
    Route route_ = Route::blend;
    float scale_ = 1;
};

BOUNCE_REGISTER_PASS("splat", SplatPass, "adds the light of photons to the pixels under their footprints")

} // namespace bounce
