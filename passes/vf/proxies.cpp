// Point proxies in cells (VF, section 3.1): the scene as discs of equal density, sorted by the cells that they lie in.
#include "core/error.h"
#include "graph/draw_starts.h"
#include "graph/list_capacity.h"
#include "graph/prefix_sum.h"
#include "graph/radix_sort.h"
#include "vf/grid.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace bounce {

class VfProxiesPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        for (const char* name : k_programs)
            description.program(name, {std::string("vf/") + name + ".comp"});
        describe_prefix_sum(description, "vf.places");
        describe_radix_sort(description, "vf.pairs");
        for (const char* name : {"draw_count", "triangle_count", "proxy_capacity", "entry_stage", "entry_capacity",
                                 "sorted_half", "arrange_stage"})
            description.constant(name);
        ParameterSet& p = description.parameters;
        p.add("proxies", proxies_, {1, 4194304}, "", "point proxies over the whole scene, in the mean");
        p.add("cells", cells_, {1, 128}, "", "along each side of the box that holds the scene");
        p.follow_need("proxies", "proxies");
        p.follow_need("cells", "cells");
        p.add("overlap", overlap_, "discs are found in every cell that they reach into; off: in their centre's");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        triangles_ = std::max<int64_t>(int64_t(d.fact(&SceneFacts::triangles)), 1);
        // Roulette makes the count vary by its root; a tenth more is beyond any chance.
        proxy_capacity_ = std::max<int64_t>(proxy_list_.entries(), int64_t(1.1 * proxies_) + 256);
        entry_capacity_ =
            std::max<int64_t>(entry_list_.entries(), overlap_ ? proxy_capacity_ * 3 / 2 : proxy_capacity_);
        const int64_t cells = int64_t(cells_) * cells_ * cells_;
        const std::string entries = std::to_string(entry_capacity_);
        auto buffer = [&](const char* name, int64_t count, int stride) -> ResourceDeclaration& {
            return d.creates_buffer(name, std::to_string(count), stride);
        };
        buffer("vf.grid", 1, sizeof(VfGrid)).overwritten = true;
        declare_draw_starts(d, "vf.draw_starts").overwritten = true;
        buffer("vf.areas", triangles_, 4).overwritten = true;
        buffer("vf.emitted", proxy_capacity_, sizeof(VfProxy)).overwritten = true;
        buffer("vf.proxies", entry_capacity_, sizeof(VfProxy)).overwritten = true;
        buffer("vf.ranges", 2 * cells + 1, 8);
        declare_prefix_sum(
            d, fmt::format("max({}, {})", std::max(triangles_, proxy_capacity_), radix_sort_values(entries)));
        declare_radix_sort(d, entries);
        d.writes("vf.grid", Usage::storage);
        for (const char* program : k_programs)
            d.uses(program);
        auto counts = [&](const std::string& label, size_t offset, bool overflow = false) {
            d.counts(label, "vf.grid", offset / 4, overflow);
        };
        counts("proxies", offsetof(VfGrid, proxies));
        counts("dropped proxies", offsetof(VfGrid, dropped), true);
        counts("entries of cells", offsetof(VfGrid, entries));
        counts("dropped entries of cells", offsetof(VfGrid, lost_copies), true);
        counts(fmt::format("proxies that the scene's area and cells ask for, of {}", proxies_), offsetof(VfGrid, used));
        counts("proxies cut away by alpha", offsetof(VfGrid, cut_away));
        counts("proxies outside of the grid", offsetof(VfGrid, outside));
        counts("entries of the fullest cell", offsetof(VfGrid, fullest));
    }

    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        bool proxies = proxy_list_.needs_larger({counted[0], counted[1]}, proxy_capacity_);
        bool entries = entry_list_.needs_larger({counted[2], counted[3]}, entry_capacity_);
        return proxies || entries;
    }

    void reset_capacity() override {
        proxy_list_.reset();
        entry_list_.reset();
    }

    void execute(PassContext& c) override {
        write_grid(c);
        const DrawStarts starts = write_draw_starts(c, "vf.draw_starts");
        c.set("draw_count", starts.draws);
        const int triangles = int(std::min<int64_t>(triangles_, starts.triangles));
        c.set("triangle_count", triangles);
        c.set("proxy_capacity", int(proxy_capacity_));
        c.set("entry_capacity", int(entry_capacity_));
        constexpr int k_row = 65536 * 32; // as in glsl/vf/areas.comp
        glm::ivec3 each_triangle(std::min(triangles + 1, k_row), (triangles + k_row) / k_row, 1);
        c.dispatch("areas", each_triangle);
        c.barrier();
        c.dispatch("density", {256, 1, 1});
        c.barrier();
        c.dispatch("count", each_triangle);
        c.barrier();
        run_prefix_sum(c, triangles);
        c.dispatch("emit", {int(proxy_capacity_), 1, 1});
        c.barrier();
        sort(c);
    }

  private:
    static constexpr const char* k_programs[] = {"areas", "density", "count", "emit", "entries", "arrange"};

    void write_grid(PassContext& c) const {
        Bounds bounds = c.fact(&SceneFacts::bounds_over_animation);
        // What lies on the box's sides lies inside; and no side is flat.
        glm::vec3 margin(1e-3f * std::max(bounds.diagonal(), 1e-6f));
        VfGrid grid{};
        grid.origin = bounds.min - margin;
        grid.overlap = overlap_ ? 1 : 0;
        grid.cell = (bounds.size() + 2.0f * margin) / float(cells_);
        grid.size = glm::ivec3(cells_);
        grid.count = cells_ * cells_ * cells_;
        grid.asked = uint32_t(proxies_);
        c.buffer("vf.grid").update(0, sizeof(grid), &grid);
    }

    void sort(PassContext& c) const {
        const int proxies = int(proxy_capacity_), entries = int(entry_capacity_);
        c.set("entry_stage", 0);
        c.dispatch("entries", {proxies + 1, 1, 1});
        c.barrier();
        run_prefix_sum(c, proxies);
        c.set("entry_stage", 1);
        c.dispatch("entries", {proxies + 1, 1, 1});
        c.barrier();
        c.set("entry_stage", 2);
        c.dispatch("entries", {entries, 1, 1});
        c.barrier();
        const unsigned last_key = 2u * unsigned(cells_ * cells_ * cells_);
        c.set("sorted_half", run_radix_sort(c, entries, std::bit_width(last_key)));
        for (int stage : {0, 1}) {
            c.set("arrange_stage", stage);
            c.dispatch("arrange", {stage == 0 ? entries : cells_ * cells_ * cells_, 1, 1});
            c.barrier();
        }
    }

    int proxies_ = 24000, cells_ = 6;
    bool overlap_ = false;
    int64_t triangles_ = 1, proxy_capacity_ = 0, entry_capacity_ = 0;
    ListCapacity proxy_list_, entry_list_;
};

BOUNCE_REGISTER_PASS("vf_proxies", VfProxiesPass,
                     "point proxies: discs over all surfaces with the same density, sorted by cells")

} // namespace bounce
