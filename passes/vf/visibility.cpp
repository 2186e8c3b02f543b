// Sparse rays and the visibility filter (VF, sections 3.1 and 3.2): for each texel of a low resolution the list of
// cells that it sees.
#include "graph/context.h"
#include "graph/list_capacity.h"

#include <algorithm>

namespace bounce {

class VfVisibilityPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("march", {"vf/march.comp"});
        description.program("aim", {"vf/aim.comp"});
        description.program("filter", {"vf/filter.comp"});
        description.constant("aimed");
        ParameterSet& p = description.parameters;
        p.add("marching_size", marching_size_, {4, 1024}, "texels",
              "height of the low resolution that rays start from");
        p.add("list_length", list_length_, {1, 1024}, "cells",
              "initial capacity of a texel's list; enlarged on overflow");
        p.add("filtered_length", filtered_length_, {1, 4096}, "cells",
              "initial capacity of a filtered list; enlarged on overflow");
        p.add("aimed", aimed_, {0, 64}, "cells",
              "each texel also aims a ray at every n-th lit cell (for visibility.ratio); 0: none, as published");
        p.add("grow", grow_,
              "lists are enlarged when cells were dropped; off: the capacity stays, and drops are counted");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        glm::ivec2 picture = d.picture_size();
        size_.y = std::min(marching_size_, picture.y);
        size_.x = std::max(1, (picture.x * size_.y + picture.y / 2) / picture.y);
        capacity_ = std::max<int>(list_length_, int(march_list_.entries()));
        filtered_capacity_ = std::max<int>(filtered_length_, int(filter_list_.entries()));
        auto lists = [&](const char* name, int capacity) {
            d.creates_buffer(name, std::to_string(int64_t(size_.x) * size_.y * (k_header + 2 * capacity)), 4)
                .overwritten = true;
        };
        lists("vf.lists", capacity_);
        lists("vf.filtered", filtered_capacity_);
        d.creates_buffer("vf.counts", "8", 4);
        d.creates_buffer("vf.sizes", "4", 4).overwritten = true;
        d.writes("vf.sizes", Usage::storage);
        d.uses("march");
        if (aimed_ > 0) d.uses("aim");
        d.uses("filter");
        d.counts("cells in the longest list", "vf.counts", 0);
        d.counts("cells dropped from lists", "vf.counts", 1, true);
        d.counts("cells in the longest filtered list", "vf.counts", 2);
        d.counts("cells dropped from filtered lists", "vf.counts", 3, true);
        d.counts("rays that met nothing", "vf.counts", 4);
    }

    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        if (!grow_) return false;
        bool lists = march_list_.needs_larger({counted[0], counted[1]}, capacity_);
        bool filtered = filter_list_.needs_larger({counted[2], counted[3]}, filtered_capacity_);
        return lists || filtered;
    }

    void reset_capacity() override {
        march_list_.reset();
        filter_list_.reset();
    }

    void execute(PassContext& c) override {
        const int32_t sizes[4] = {size_.x, size_.y, capacity_, filtered_capacity_};
        c.buffer("vf.sizes").update(0, sizeof(sizes), sizes);
        c.dispatch("march", {size_, 1});
        c.barrier();
        if (aimed_ > 0) {
            c.set("aimed", aimed_);
            c.dispatch("aim", {size_, 1});
            c.barrier();
        }
        c.dispatch("filter", {size_, 1});
    }

  private:
    static constexpr int k_header = 4; ///< numbers before a list's entries, as in glsl/vf/lists.glsl
    int marching_size_ = 64, list_length_ = 32, filtered_length_ = 128, aimed_ = 0;
    bool grow_ = true;
    glm::ivec2 size_{1};
    int capacity_ = 0, filtered_capacity_ = 0;
    ListCapacity march_list_, filter_list_;
};

BOUNCE_REGISTER_PASS("vf_visibility", VfVisibilityPass,
                     "sparse rays through the cells, and the visibility filter: which cells each texel sees")

} // namespace bounce
