#include "lpv/cell_sort.h"

#include "core/error.h"
#include "graph/prefix_sum.h"
#include "graph/radix_sort.h"

#include <algorithm>
#include <bit>

namespace bounce {

static int graph_parameter(const PassContext& c, const std::string& name) {
    const std::optional<double> value = c.number("graph." + name);
    if (!value) throw Error("light propagation volumes need a parameter '" + name + "' of the graph");
    return int(*value);
}
int lpv_cells(const PassContext& c) {
    return graph_parameter(c, "cells");
}
int lpv_cascades(const PassContext& c) {
    return graph_parameter(c, "cascades");
}

void describe_cell_sort(PassDescription& description, const std::string& pairs, const std::string& keys,
                        const std::string& arrange) {
    description.program("keys", {keys});
    description.program("arrange", {arrange});
    describe_prefix_sum(description, pairs + "_places");
    describe_radix_sort(description, pairs);
    for (const char* name : {"entry_count", "cell_count", "cascade_index", "sorted_half"})
        description.constant(name);
}

void declare_cell_sort(Declaration& d, const std::string& entries) {
    declare_prefix_sum(d, radix_sort_values(entries));
    declare_radix_sort(d, entries);
    d.uses("keys");
    d.uses("arrange");
}

void run_cell_sort(PassContext& c, int64_t entries, int cells) {
    constexpr int64_t k_row = 65536 * 32; // as in glsl/lpv/ranges.glsl
    const glm::ivec3 each_entry(std::min(entries, k_row), (entries + k_row - 1) / k_row, 1);
    c.set("entry_count", int(entries));
    c.set("cell_count", cells);
    const int cascades = lpv_cascades(c);
    for (int cascade = 0; cascade < cascades; ++cascade) {
        c.set("cascade_index", cascade);
        c.dispatch("keys", each_entry);
        c.barrier();
        c.set("sorted_half", run_radix_sort(c, entries, std::bit_width(unsigned(cells))));
        c.dispatch("arrange", each_entry);
        if (cascade + 1 < cascades) c.barrier();
    }
}

} // namespace bounce
