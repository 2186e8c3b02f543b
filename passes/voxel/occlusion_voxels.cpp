// Occlusion voxels (LRSM, section 5): one byte a voxel, 0 or 255, built each frame without atomics.
#include "core/error.h"
#include "core/parameter_steps.h"
#include "graph/draw_starts.h"

#include <bit>

namespace bounce {

class OcclusionVoxelsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("raster", {"voxel/voxelize.vert", "voxel/occlusion.geom", "voxel/occlusion.frag"});
        description.program("compute", {"voxel/occlusion.comp"});
        description.program("bits", {"voxel/occlusion_bits.comp"});
        description.program("brick_mip", {"voxel/brick_mip.comp"});
        description.constant("resolution_of_grid");
        ParameterSet& p = description.parameters;
        p.add("resolution", resolution_, {8, 512}, "voxels", "along each side of the grid; a power of two");
        choose_powers_of_two(p, "resolution");
        p.follow_need("resolution", "occlusion_voxels");
        p.add_choice("route", route_, {"raster", "compute"},
                     "raster: dominant axis, as published; compute: every voxel that is overlapped");
        p.add_choice("storage", storage_, {"bytes", "bits"},
                     "one byte per voxel (published), or one bit in eight rounds (route=compute)");
        p.add("directional_leaves", directional_leaves_,
              "six volumes by facing, so that a surface does not block what leaves it");
    }

    void declare(Declaration& d) override {
        int slices = resolution_ * (directional_leaves_ ? 6 : 1);
        bool bits = storage_ == Storage::bits;
        if (bits && route_ == Route::raster) throw Error("storage = bits needs route = compute");
        int base = bits ? resolution_ / 2 : resolution_; // bits: the first mip is the finest with a byte a voxel
        slices = bits ? slices / 2 : slices;
        ResourceDeclaration& voxels =
            d.creates("voxels.occlusion", ResourceKind::texture_3d, "r8", {base, base, slices});
        voxels.mips = std::to_string(std::bit_width(unsigned(base)));
        if (route_ == Route::raster) {
            d.uses("raster");
            return;
        }
        declare_draw_starts(d, "voxels.draw_starts");
        d.uses(bits ? "bits" : "compute");
        if (bits) {
            d.creates("voxels.bricks", ResourceKind::texture_3d, "r8ui", {base, base, slices});
            d.uses("brick_mip");
            d.repeat(0, 8);
        }
    }

    void execute(PassContext& c) override {
        c.set("resolution_of_grid", resolution_);
        if (route_ == Route::raster) {
            Targets none;
            none.size = glm::ivec2(resolution_);
            glDisable(GL_DEPTH_TEST);
            c.draw_scene("raster", none);
            return;
        }
        constexpr int k_lanes = 16, k_row = 65536; // as in voxel/occlusion.comp
        int triangles = write_draw_starts(c, "voxels.draw_starts").triangles;
        c.dispatch(storage_ == Storage::bits ? "bits" : "compute",
                   {std::min(triangles, k_row) * k_lanes, (triangles + k_row - 1) / k_row, 1});
        if (storage_ == Storage::bits && c.iteration == 7) {
            c.barrier();
            c.dispatch("brick_mip", c.texture("voxels.occlusion").desc().size);
        }
    }

  private:
    enum class Route { raster, compute };
    enum class Storage { bytes, bits };
    int resolution_ = 128;
    Route route_ = Route::raster;
    Storage storage_ = Storage::bytes;
    bool directional_leaves_ = false;
};

BOUNCE_REGISTER_PASS("occlusion_voxels", OcclusionVoxelsPass,
                     "which voxels hold geometry: one byte each, raster or compute, no atomics")

} // namespace bounce
