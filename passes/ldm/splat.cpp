// Photon splatting (LDM, section 4.2): every photon of a batch adds its light to the pixels under its footprint. By
// blending, as published, or in compute: photons are binned by tiles, and each pixel adds up those of its tile.
#include "graph/context.h"
#include "graph/list_capacity.h"
#include "graph/prefix_sum.h"

#include <cmath>

namespace bounce {

class SplatPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("blend", {"ldm/splat.vert", "ldm/splat.frag"});
        description.program("boxes", {"ldm/splat_boxes.comp"});
        description.program("bins", {"ldm/splat_bins.comp"});
        description.program("tiles", {"ldm/splat_tiles.comp"});
        describe_prefix_sum(description, "splat.places");
        description.constant("bin_stage");
        description.constant("chunk_count");
        description.parameters.add_choice("route", route_, {"blend", "tiles"},
                                          "blended quads as published, or compute by tiles of 8 × 8 pixels");
        description.parameters.add("scale", scale_, {0.125, 1}, "",
                                   "size of the picture that photons are splatted to, as a share of the picture");
        description.constant("splat_size");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no lights";
    }

    void declare(Declaration& d) override {
        d.creates("photons.irradiance", ResourceKind::texture_2d, "rgba32f",
                  Extent(size(d.picture_size().x), size(d.picture_size().y)));
        d.reads("photons.commands", Usage::indirect);
        if (route_ == Route::blend) {
            d.uses("blend");
            d.reads_and_writes("photons.irradiance", Usage::colour);
        } else {
            d.creates_buffer("photons.boxes", "photons.stored.count", 8).overwritten = true;
            d.creates_buffer("photons.chunks", "ceil(photons.stored.count / 256)", 8).overwritten = true;
            int tiles = ((size(d.picture_size().x) + 7) / 8) * ((size(d.picture_size().y) + 7) / 8);
            declare_prefix_sum(d, "photons.chunks.count * " + std::to_string(tiles));
            d.creates_buffer("splat.lists",
                             list_.entries() > 0 ? std::to_string(list_.entries()) : "4 * photons.stored.count", 4)
                .overwritten = true;
            d.creates_buffer("splat.counts", "2", 4);
            d.counts("photons in the tiles of the largest batch", "splat.counts", 0);
            d.counts("dropped tile entries", "splat.counts", 1, true);
            for (const char* program : {"boxes", "bins", "tiles"})
                d.uses(program);
        }
    }

    bool needs_larger_buffers(const std::vector<int64_t>& counted) override { return list_.needs_larger(counted); }

    void reset_capacity() override { list_.reset(); }

    void execute(PassContext& c) override {
        c.set("splat_size", glm::vec2(c.size("photons.irradiance")));
        if (route_ == Route::blend) {
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
            c.draw_arrays_indirect("blend", {{"photons.irradiance"}, ""}, GL_TRIANGLE_STRIP, "photons.commands");
            return;
        }
        c.dispatch_indirect("boxes", "photons.commands", 4 * sizeof(uint32_t));
        glm::ivec2 picture = c.size("photons.irradiance");
        int tiles = ((picture.x + 7) / 8) * ((picture.y + 7) / 8);
        int chunks = int(c.buffer("photons.chunks").bytes() / 8);
        c.set("chunk_count", chunks);
        for (int stage : {0, 1}) {
            c.barrier();
            c.set("bin_stage", stage);
            c.dispatch("bins", {chunks, tiles, 1});
            c.barrier();
            if (stage == 0) run_prefix_sum(c, int64_t(chunks) * tiles);
        }
        c.dispatch("tiles", {picture, 1});
    }

  private:
    enum class Route { blend, tiles };
    int size(int side) const { return int(std::ceil(float(side) * scale_)); }

    Route route_ = Route::blend;
    float scale_ = 1;
    ListCapacity list_;
};

BOUNCE_REGISTER_PASS("splat", SplatPass, "adds the light of photons to the pixels under their footprints")

} // namespace bounce
