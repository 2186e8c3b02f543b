// Layered depth maps (LDM, section 3 and 4): N orthographic views, each texel a list of all surfaces along the axis,
// sorted while it is built. Built in batches that fit a memory limit; what uses them takes its steps in the same loop.
#include "graph/context.h"
#include "ldm/directions.h"
#include "ldm/views.h"

#include <algorithm>
#include <cmath>

namespace bounce {

class LayeredDepthMapsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("build", {"ldm/build.vert", "ldm/build.frag"});
        for (const char* name : {"start_batch", "finish_batch"})
            description.program(name, {std::string("ldm/") + name + ".comp"});
        description.constant("batch");
        ParameterSet& p = description.parameters;
        p.add("maps", maps_, {1, 4096}, "", "N: axes, and so maps; each serves both of its directions");
        p.add("resolution", resolution_, {4, 1024}, "texels", "width and height of each map");
        p.add_choice(
            "nodes", nodes_, {"depth", "plane", "surface"},
            "what a fragment leaves: its depth (8 bytes with the link), also the slope of its plane (12), also "
            "its albedo (16)");
        p.add("tilted", tilted_, "axes are turned off the world's axes, along which walls are often built");
        p.add("rotate", rotate_, "axes turn from frame to frame, for accumulation over frames");
        p.add("memory", memory_, {1, 16384}, "MiB", "largest size of a batch's lists; more maps take more batches");
        p.add("fragments", fragments_, {0.1, 1000}, "per texel",
              "nodes that the first build of a batch has room for; it grows to what is asked for");
    }

    void declare(Declaration& d) override {
        // What a batch takes: a head a texel, and its nodes with a reserve, since batches differ a little.
        int64_t texels = int64_t(resolution_) * resolution_;
        double density = std::max(double(fragments_), grown_);
        double map_bytes = double(texels) * 4 * (1 + node_words() * density);
        slots_ = int(std::clamp(memory_ * 1048576.0 / map_bytes, 1.0, double(maps_)));
        batches_ = (maps_ + slots_ - 1) / slots_;
        slots_ = (maps_ + batches_ - 1) / batches_;
        capacity_ = std::max<int64_t>(int64_t(std::ceil(double(texels * slots_) * density)), 64);
        d.creates_buffer("ldm.views", std::to_string(maps_), sizeof(LdmView)).overwritten = true;
        d.creates_buffer("ldm.info", "1", sizeof(LdmInfo)).overwritten = true;
        d.creates_buffer("ldm.lists", std::to_string(texels * slots_ + capacity_ * node_words()), 4).overwritten = true;
        d.creates_buffer("ldm.counts", "8", 4);
        d.creates_buffer("ldm.batches", std::to_string(batches_), 4);
        for (const char* name : {"ldm.views", "ldm.info", "ldm.lists"})
            d.writes(name, Usage::storage);
        d.counts("fragments in the largest batch", "ldm.counts", 1);
        d.counts("fragments without room", "ldm.counts", 2, true);
        d.counts("fragments of all maps", "ldm.counts", 3);
        for (const char* program : {"build", "start_batch", "finish_batch"})
            d.uses(program);
        d.repeat(0, batches_, "ldm");
    }

    /// Room for what the largest batch had asked for, and some more.
    bool outgrown(const std::vector<int64_t>& counted) override {
        if (counted.size() < 2 || counted[1] <= 0) return false;
        double texels = double(resolution_) * resolution_ * slots_;
        double wanted = 1.1 * double(counted[0]) / texels;
        if (wanted <= grown_ || double(counted[0]) <= double(capacity_)) return false;
        grown_ = wanted;
        return true;
    }

    void execute(PassContext& c) override {
        auto wait = [](GLbitfield bits = GL_SHADER_STORAGE_BARRIER_BIT) { glMemoryBarrier(bits); };
        if (c.iteration == 0) write_views(c);
        c.set("batch", c.iteration);
        c.dispatch("start_batch", {std::min(slots_ * resolution_ * resolution_, 1 << 22), 1, 1});
        wait();
        int slots = (maps_ - c.iteration + batches_ - 1) / batches_;
        Targets none;
        none.size = glm::ivec2(resolution_);
        DrawOptions options;
        options.instances = slots;
        c.draw_scene("build", none, options);
        wait();
        c.dispatch("finish_batch", {1, 1, 1});
    }

  private:
    enum class Nodes { depth, plane, surface };
    int node_words() const { return 2 + int(nodes_); }

    void write_views(PassContext& c) {
        std::vector<LdmView> views;
        glm::mat3 turn = rotate_ ? turn_of_frame(c.frame().frame_index) : glm::mat3(1);
        if (tilted_) turn = turn * tilt_off_axes();
        for (glm::vec3 direction : ldm_directions(maps_))
            views.push_back(ldm_view(glm::normalize(turn * direction), c.facts().bounds_over_animation, resolution_));
        c.buffer("ldm.views").update(0, views.size() * sizeof(LdmView), views.data());
        LdmInfo info{maps_,        resolution_,        batches_, slots_, slots_ * resolution_ * resolution_,
                     node_words(), int32_t(capacity_), 0};
        c.buffer("ldm.info").update(0, sizeof(info), &info);
    }

    int maps_ = 512, resolution_ = 200;
    Nodes nodes_ = Nodes::depth;
    bool tilted_ = false, rotate_ = false;
    int memory_ = 120;
    float fragments_ = 4;
    double grown_ = 0; ///< nodes a texel that a batch was found to need
    int slots_ = 1, batches_ = 1;
    int64_t capacity_ = 0;
};

BOUNCE_REGISTER_PASS("ldm", LayeredDepthMapsPass,
                     "layered depth maps along N axes: a sorted list of all surfaces in each texel")

} // namespace bounce
