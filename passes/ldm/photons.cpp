// Photon tracing (LDM, section 4.2): the photons of punctual lights, split at their first hit over the axes of
// each batch of layered depth maps, traced in them, and stored where the camera sees them arrive.
#include "ldm/photons.h"

#include "core/error.h"
#include "graph/context.h"
#include "graph/list_capacity.h"
#include "graph/prefix_sum.h"

#include <algorithm>
#include <cmath>

namespace bounce {

class PhotonsPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        for (const char* name : {"primaries", "trace_photons", "store_photons", "finish_photons"})
            description.program(name, {std::string("ldm/") + name + ".comp"});
        describe_prefix_sum(description, "photons.places");
        for (const char* name : {"batch", "emitter_count", "value_count"})
            description.constant(name);
        description.parameters.add("second_axes", second_axes_, {0, 64}, "axes",
                                   "second bounce: axes per photon (needs ldm.nodes=surface); 0: off, as published");
        description.parameters.add("third_axes", third_axes_, {0, 16}, "axes",
                                   "third bounce: axes per photon (needs second_axes)");
        description.parameters.add("photons", initial_share_, {0.001, 1}, "per photon traced",
                                   "initial capacity, share of a batch's photons; enlarged on overflow");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no lights";
    }

    void declare(Declaration& d) override {
        for (const char* program : {"primaries", "trace_photons", "store_photons", "finish_photons"})
            d.uses(program);
        // Sizes by expressions: the maps' and the reflective shadow maps' are other passes' parameters.
        const std::string emitters = "(rsm.depth.width * rsm.depth.height * rsm.depth.depth)";
        const std::string values =
            emitters + " * ceil(ldm.views.count / ldm.batches.count) * " + std::to_string(paths());
        d.creates_buffer("photons.emitters", emitters, sizeof(Emitter)).overwritten = true;
        d.creates_buffer("photons.outcomes", values, 4).overwritten = true;
        d.creates_buffer("photons.commands", "8", 4).overwritten = true;
        d.creates_buffer("photons.counts", "4", 4);
        d.creates_buffer("photons.stored",
                         list_.entries() > 0
                             ? std::to_string(list_.entries())
                             : "max(256, ceil(" + values + " * " + std::to_string(initial_share_) + "))",
                         sizeof(Photon))
            .overwritten = true;
        declare_prefix_sum(d, values);
        d.counts("photons in the largest batch", "photons.counts", 0);
        d.counts("dropped photons", "photons.counts", 1, true);
        d.counts("photons that arrive where the camera looks", "photons.counts", 2);
    }

    bool needs_larger_buffers(const std::vector<int64_t>& counted) override { return list_.needs_larger(counted); }

    void reset_capacity() override { list_.reset(); }

    void execute(PassContext& c) override {
        glm::ivec3 map = c.texture("rsm.depth").desc().size;
        int emitters = map.x * map.y * map.z;
        int slots = int(c.buffer("photons.outcomes").bytes() / 4 / size_t(emitters * paths()));
        if (second_axes_ > 0 && c.number("ldm.nodes").value_or(0) < 2)
            throw Error("more than one bounce needs the normal and albedo of what photons meet: set ldm.nodes=surface");
        c.set("batch", c.iteration);
        c.set("emitter_count", emitters);
        c.set("value_count", emitters * slots * paths());
        if (c.iteration == 0) {
            c.dispatch("primaries", map);
            c.barrier();
        }
        c.dispatch("trace_photons", {emitters, slots, paths()});
        c.barrier();
        run_prefix_sum(c, int64_t(emitters) * slots * paths());
        c.dispatch("store_photons", {emitters, slots, paths()});
        c.barrier();
        c.dispatch("finish_photons", {1, 1, 1});
    }

  private:
    int paths() const { return 1 + second_axes_ * (1 + third_axes_); }

    int second_axes_ = 0, third_axes_ = 0;
    float initial_share_ = 0.25f;
    ListCapacity list_;
};

BOUNCE_REGISTER_PASS("photons", PhotonsPass,
                     "photon differentials: split at their first hit, traced in layered depth maps, stored where seen")

} // namespace bounce
