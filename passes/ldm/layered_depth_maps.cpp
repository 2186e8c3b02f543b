// Layered depth maps (LDM, section 3 and 4): N orthographic views, each texel a list of all surfaces along the axis,
// sorted while it is built. Built in batches that fit a memory limit; what uses them takes its steps in the same loop.
#include "gpu/driver_limits.h"
#include "graph/context.h"
#include "graph/list_capacity.h"
#include "graph/prefix_sum.h"
#include "ldm/directions.h"
#include "ldm/views.h"

#include <algorithm>
#include <cmath>

namespace bounce {

class LayeredDepthMapsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("build", {"ldm/build.vert", "ldm/build.frag"});
        description.program("build_by_compute", {"ldm/build.comp"});
        for (const char* name : {"start_batch", "finish_batch", "list_lengths", "write_arrays"})
            description.program(name, {std::string("ldm/") + name + ".comp"});
        describe_prefix_sum(description, "ldm.places");
        for (const char* name : {"batch", "draw_count", "slot_count", "bands", "marks_from"})
            description.constant(name);
        ParameterSet& p = description.parameters;
        p.add("maps", maps_, {1, 4096}, "", "N: axes, and so maps; each serves both of its directions");
        p.follow_need("maps", "axes");
        p.add("resolution", resolution_, {4, 1024}, "texels", "width and height of each map");
        p.add_choice("route", route_, {"raster", "compute"},
                     "raster: all maps of a batch in one draw, as published; compute: no rasterizer");
        p.add_choice("storage", storage_, {"lists", "arrays"},
                     "lists: linked, as published; arrays: rewritten in order once complete");
        p.add_choice("nodes", nodes_, {"depth", "plane", "surface"},
                     "what a node holds: depth (8 bytes), also its plane (12), also its albedo (16)");
        p.add("tilted", tilted_, "axes are turned off the world's axes, along which walls are often built");
        p.add("rotate", rotate_, "axes turn from frame to frame, for accumulation over frames");
        p.add("memory", memory_, {1, 16384}, "MiB",
              "largest size of a batch's lists (a storage block's at most); more maps: more batches");
        p.add("fragments", fragments_, {0.1, 1000}, "per texel",
              "initial capacity of a batch's nodes; enlarged on overflow");
    }

    void declare(Declaration& d) override {
        // What a batch takes: a head a texel, and its nodes with a reserve, since batches differ a little.
        int64_t texels = int64_t(resolution_) * resolution_;
        double density = std::max(double(fragments_), nodes_a_texel_);
        double map_bytes = double(texels) * 4 * (1 + node_words() * density);
        if (arrays()) map_bytes += double(texels) * 4 * (2 + (node_words() - 1) * density);
        const double block = double(driver_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
        slots_ = int(std::clamp(std::min(memory_ * 1048576.0, block) / map_bytes, 1.0, double(maps_)));
        batches_ = (maps_ + slots_ - 1) / slots_;
        slots_ = (maps_ + batches_ - 1) / batches_;
        capacity_ = std::max<int64_t>(int64_t(std::ceil(double(texels * slots_) * density)), 64);
        d.creates_buffer("ldm.views", std::to_string(maps_), sizeof(LdmView)).overwritten = true;
        d.creates_buffer("ldm.info", "1", sizeof(LdmInfo)).overwritten = true;
        d.creates_buffer("ldm.lists", std::to_string(texels * slots_ + capacity_ * node_words()), 4).overwritten = true;
        // Behind the counters: the draws' first triangles, and a word for each group of triangles in each map of a
        // batch (see ldm/build.comp).
        int64_t groups = route_ == Route::compute ? groups_of(int64_t(d.fact(&SceneFacts::triangles))) + 1 : 0;
        d.creates_buffer("ldm.counts",
                         std::to_string(k_counts + int64_t(d.fact(&SceneFacts::instances)) + 1 + 2 * groups * slots_),
                         4);
        d.creates_buffer("ldm.batches", std::to_string(batches_), 4);
        for (const char* name : {"ldm.views", "ldm.info", "ldm.lists"})
            d.writes(name, Usage::storage);
        d.counts("fragments in the largest batch", "ldm.counts", 1);
        d.counts("dropped fragments", "ldm.counts", 2, true);
        d.counts("fragments of all maps", "ldm.counts", 3);
        d.counts("KiB of all lists", "ldm.counts", 4);
        d.uses(route_ == Route::raster ? "build" : "build_by_compute");
        for (const char* program : {"start_batch", "finish_batch"})
            d.uses(program);
        if (arrays()) {
            int64_t heads = texels * slots_;
            d.creates_buffer("ldm.arrays", std::to_string(heads + 1 + capacity_ * (node_words() - 1)), 4).overwritten =
                true;
            declare_prefix_sum(d, std::to_string(heads));
            d.uses("list_lengths");
            d.uses("write_arrays");
        }
        d.repeat(0, batches_, "ldm");
    }

    /// As many nodes a texel as the fullest batch needs: the next plan may divide the maps into other batches.
    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        if (!list_.needs_larger(counted, capacity_)) return false;
        nodes_a_texel_ = double(list_.entries()) / (double(resolution_) * resolution_ * slots_);
        return true;
    }

    void reset_capacity() override {
        list_.reset();
        nodes_a_texel_ = 0;
    }

    void execute(PassContext& c) override {
        if (c.iteration == 0) write_views(c);
        c.set("batch", c.iteration);
        int heads = slots_ * resolution_ * resolution_, for_each_head = std::min(heads, 1 << 22);
        c.set("marks_from", int(k_counts + c.draws().size() + 1));
        c.dispatch("start_batch", {for_each_head, 1, 1});
        c.barrier();
        build(c, (maps_ - c.iteration + batches_ - 1) / batches_);
        c.barrier();
        if (arrays()) {
            c.dispatch("list_lengths", {for_each_head, 1, 1});
            c.barrier();
            run_prefix_sum(c, heads);
            c.dispatch("write_arrays", {for_each_head, 1, 1});
            c.barrier();
        }
        c.dispatch("finish_batch", {1, 1, 1});
    }

  private:
    enum class Nodes { depth, plane, surface };
    enum class Route { raster, compute };
    enum class Storage { lists, arrays };
    static constexpr size_t k_counts = 8; ///< numbers in ldm.counts before the draws' first triangles
    bool arrays() const { return storage_ == Storage::arrays; }
    int node_words() const { return 2 + int(nodes_); }

    /// The fragments of `slots` maps.
    void build(PassContext& c, int slots) {
        if (route_ == Route::raster) {
            Targets none;
            none.size = glm::ivec2(resolution_);
            DrawOptions options;
            options.instances = slots;
            c.draw_scene("build", none, options);
            return;
        }
        const std::vector<GpuDraw>& draws = c.draws();
        std::vector<uint32_t> starts{0};
        for (const GpuDraw& draw : draws)
            starts.push_back(starts.back() + draw.index_count / 3);
        if (c.iteration == 0)
            c.buffer("ldm.counts").update(k_counts * sizeof(uint32_t), starts.size() * sizeof(uint32_t), starts.data());
        if (starts.back() == 0) return;
        int groups = int(std::min<int64_t>(groups_of(starts.back()), 65535));
        c.set("draw_count", int(draws.size()));
        c.set("slot_count", slots_);
        c.set("bands", 0);
        c.dispatch("build_by_compute", {groups * k_group, (slots + k_maps_each - 1) / k_maps_each, 1});
        c.barrier();
        // In the second round an invocation looks at a sixty-fourth of up to 64 triangles of up to so many texels.
        constexpr int k_band_texels = 16384;
        int bands = std::min((resolution_ * resolution_ + k_band_texels - 1) / k_band_texels, resolution_);
        c.set("bands", bands);
        c.dispatch("build_by_compute", {groups * k_group, slots, bands});
    }
    static constexpr int k_group = 64, k_maps_each = 16; ///< triangles and maps, as in ldm/build.comp
    static int64_t groups_of(int64_t triangles) { return (triangles + k_group - 1) / k_group; }

    void write_views(PassContext& c) {
        std::vector<LdmView> views;
        glm::mat3 turn = rotate_ ? turn_of_frame(c.frame(&FrameConstants::frame_index)) : glm::mat3(1);
        if (tilted_) turn = turn * tilt_off_axes();
        for (glm::vec3 direction : ldm_directions(maps_))
            views.push_back(
                ldm_view(glm::normalize(turn * direction), c.fact(&SceneFacts::bounds_over_animation), resolution_));
        c.buffer("ldm.views").update(0, views.size() * sizeof(LdmView), views.data());
        LdmInfo info{maps_,        resolution_,        batches_,        slots_, slots_ * resolution_ * resolution_,
                     node_words(), int32_t(capacity_), arrays() ? 1 : 0};
        c.buffer("ldm.info").update(0, sizeof(info), &info);
    }

    int maps_ = 512, resolution_ = 200;
    Nodes nodes_ = Nodes::depth;
    Route route_ = Route::raster;
    Storage storage_ = Storage::lists;
    bool tilted_ = false, rotate_ = false;
    int memory_ = 120;
    float fragments_ = 4;
    ListCapacity list_;
    double nodes_a_texel_ = 0; ///< that a batch was found to need
    int slots_ = 1, batches_ = 1;
    int64_t capacity_ = 0;
};

BOUNCE_REGISTER_PASS("ldm", LayeredDepthMapsPass,
                     "layered depth maps along N axes: a sorted list of all surfaces in each texel")

} // namespace bounce
