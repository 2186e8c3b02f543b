// Voxelization of the scene into albedo, normal and emission volumes, static and dynamic geometry apart (DVS, section
// V).
#include "core/parameter_steps.h"
#include "graph/draw_starts.h"

namespace bounce {

class VoxelizationPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        for (const char* name : {"mark", "voxelize", "compact", "finish_list", "clear_dynamic", "forget_dynamic",
                                 "resolve", "triangle_bounds", "gather_fragments"})
            description.program(name, {std::string("dvs/") + name + ".comp"});
        description.program("raster", {"voxel/voxelize.vert", "dvs/voxelize.geom", "dvs/voxelize.frag"});
        for (const char* name :
             {"resolution_of_grid", "operation", "kind", "emission_scale", "triangle_count", "level", "first_box"})
            description.constant(name);
        ParameterSet& p = description.parameters;
        p.add("resolution", resolution_, {8, 512}, "voxels", "along each side of the grid; a power of two");
        choose_powers_of_two(p, "resolution");
        p.follow_need("resolution", "voxels");
        p.add_choice("route", route_, {"raster", "compute"},
                     "raster: conservative, as published; compute: every voxel that is overlapped");
        // average: packed running means by compare-and-swap, as published. last_writer: one triangle's surface. sum:
        // integer sums by atomic adds, the same in every run. gather: the same sums without atomics, each voxel going
        // through its triangles (route=compute).
        p.add_choice("averaging", averaging_, {"average", "last_writer", "sum", "gather"},
                     "how the fragments of a voxel become one");
        p.add("planes", planes_, "exact hits on each voxel's mean plane (not for averaging=average)");
        p.add("static_once", static_once_, "voxelizes static geometry only when it changes, as published");
        p.add("capacity", capacity_, {1, 256}, "",
              "initial capacity of the list of voxels, in faces of the grid; enlarged on overflow");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() || facts.emissive_materials ? "" : "the scene has neither lights nor emissive materials";
    }

    void declare(Declaration& d) override {
        using enum ResourceKind;
        emission_ = d.fact(&SceneFacts::emissive_materials) > 0;
        auto volume = [&](const char* name, const char* format) {
            d.creates(name, texture_3d, format, {resolution_, resolution_, resolution_}).incremental = static_once_;
        };
        volume("voxels.place", "r32ui");
        volume("voxels.flags", "r8ui");
        volume("voxels.albedo", "rgba8");
        volume("voxels.normal", "rgba8_snorm");
        int bricks = (resolution_ + 3) / 4;
        d.creates("voxels.bricks", texture_3d, "r8ui", {bricks, bricks, bricks}).incremental = static_once_;
        if (emission_) volume("voxels.emission", "rgba16f");
        const int64_t face = int64_t(resolution_) * resolution_;
        list_capacity_ = std::min(std::max(face * capacity_, grown_), face * resolution_);
        const std::string capacity = std::to_string(list_capacity_);
        auto list = [&](const char* name, const std::string& count, int stride) {
            d.creates_buffer(name, count, stride).incremental = static_once_;
        };
        list("voxels.list", capacity, 4);
        list("voxels.counts", "8", 4);
        if (averaging_ == Averaging::average) {
            volume("voxels.packed_albedo", "r32ui");
            volume("voxels.packed_normal", "r32ui");
            if (emission_) volume("voxels.packed_emission", "r32ui");
        } else {
            list("voxels.sums", capacity, averaging_ == Averaging::last_writer ? 4 : 13 * 4);
        }
        declare_draw_starts(d, "voxels.draw_starts").incremental = static_once_;
        if (averaging_ == Averaging::gather) {
            // Boxes around triangles, around 64 of them, and around 64 of those: two corners each.
            uint64_t triangles = d.fact(&SceneFacts::triangles);
            uint64_t boxes = triangles + triangles / 64 + triangles / 4096 + 2;
            list("voxels.triangle_bounds", std::to_string(2 * boxes), 16);
            d.uses("triangle_bounds");
            d.uses("gather_fragments");
        }
        if (by_raster()) {
            d.uses("raster");
        } else {
            if (averaging_ != Averaging::average) d.uses("mark");
            if (averaging_ == Averaging::average || averaging_ == Averaging::sum) d.uses("voxelize");
        }
        for (const char* program : {"compact", "finish_list", "resolve"})
            d.uses(program);
        d.counts("occupied voxels", "voxels.counts", 3);
        d.counts("of them of static geometry", "voxels.counts", 4);
        d.counts("dropped voxels", "voxels.counts", 5, true);
        bool dynamic = d.fact(&SceneFacts::dynamic_instances) > 0;
        if (dynamic) d.uses("clear_dynamic"), d.uses("forget_dynamic");
    }

    /// How many voxels were dropped is not told, only by how many fragments: so it grows by steps.
    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        const int64_t all = int64_t(resolution_) * resolution_ * resolution_;
        if (counted.size() < 3 || counted[2] <= 0 || list_capacity_ >= all) return false;
        grown_ = std::min(4 * list_capacity_, all);
        return true;
    }
    void reset_capacity() override { grown_ = 0; }

    void execute(PassContext& c) override {
        float brightest = 0;
        for (const Material& m : c.materials())
            brightest = std::max({brightest, m.emission.x, m.emission.y, m.emission.z});
        c.set("resolution_of_grid", resolution_);
        c.set("emission_scale", emission_ ? brightest : 0.0f);

        if (!c.stands("voxels.counts")) {
            const uint32_t none[8] = {0, 0, 1, 0, 0, 0, 0, 0};
            c.buffer("voxels.counts").update(0, sizeof(none), none);
            add(c, k_static, 0u);
        } else if (c.fact(&SceneFacts::dynamic_instances) > 0) {
            c.dispatch_indirect("clear_dynamic", "voxels.counts");
            c.barrier();
            c.dispatch("forget_dynamic", {1, 1, 1});
            c.barrier();
        }
        if (c.fact(&SceneFacts::dynamic_instances) > 0 && static_once_) add(c, k_dynamic, 1u);
    }

  private:
    enum class Route { raster, compute };
    enum class Averaging { average, last_writer, sum, gather };
    static constexpr int k_static = 1, k_dynamic = 2;          // as in dvs/list.glsl
    static constexpr int k_mark = 0, k_add = 1, k_average = 2; // as in dvs/fragment_store.glsl
    static constexpr int k_row = 65536;                        // as in voxel/triangle_voxels.glsl

    /// A voxel's owner finds the triangles that overlap it exactly: so must those that mark it.
    bool by_raster() const { return route_ == Route::raster && averaging_ != Averaging::gather; }

    /// Voxelizes the draws of one kind into voxels that no static geometry holds.
    void add(PassContext& c, int kind, uint32_t flag) {
        // A draw of the other kind has no triangles here.
        const int triangles = write_draw_starts(c, "voxels.draw_starts", [&](const GpuDraw& draw) {
                                  return (draw.flags & 1u) == flag || !static_once_;
                              }).triangles;
        auto visit = [&](const char* by_compute) {
            if (by_raster()) {
                Targets none;
                none.size = glm::ivec2(resolution_);
                DrawOptions options;
                options.which = !static_once_ ? DrawOptions::Which::all
                                : flag        ? DrawOptions::Which::dynamic_only
                                              : DrawOptions::Which::static_only;
                c.draw_scene("raster", none, options);
                return;
            }
            constexpr int k_lanes = 16; // as in voxel/triangle_voxels.glsl
            c.dispatch(by_compute, {std::min(triangles, k_row) * k_lanes, (triangles + k_row - 1) / k_row, 1});
        };
        c.set("kind", kind);
        c.set("operation", averaging_ == Averaging::average ? k_average : k_mark);
        c.barrier();
        visit(averaging_ == Averaging::average ? "voxelize" : "mark");
        c.barrier();
        int bricks = (resolution_ + 3) / 4;
        c.dispatch("compact", {bricks * bricks * bricks, 1, 1});
        c.barrier();
        c.dispatch("finish_list", {1, 1, 1});
        c.barrier();
        if (averaging_ == Averaging::sum) {
            c.set("operation", k_add);
            visit("voxelize");
            c.barrier();
        }
        if (averaging_ == Averaging::gather) gather_fragments(c, triangles);
        c.dispatch_indirect("resolve", "voxels.counts");
        c.barrier();
    }

    void gather_fragments(PassContext& c, int triangles) {
        c.set("triangle_count", triangles);
        for (int level = 0; level < 3; ++level) {
            c.set("level", level);
            int boxes = (triangles + (1 << (6 * level)) - 1) >> (6 * level);
            c.dispatch("triangle_bounds", {std::min(boxes, k_row), (boxes + k_row - 1) / k_row, 1});
            c.barrier();
        }
        for (int first = 0; first < (triangles + 4095) / 4096; first += 8) {
            c.set("first_box", first);
            c.dispatch_indirect("gather_fragments", "voxels.counts");
            c.barrier();
        }
    }

    int resolution_ = 128;
    Route route_ = Route::raster;
    Averaging averaging_ = Averaging::average;
    bool static_once_ = true, emission_ = false, planes_ = false;
    int64_t list_capacity_ = 0, grown_ = 0; ///< entries of the list; what overflow asked for
    int capacity_ = 32;
};

BOUNCE_REGISTER_PASS("voxelization", VoxelizationPass,
                     "albedo, normal and emission of each voxel, static and dynamic geometry apart")

} // namespace bounce
