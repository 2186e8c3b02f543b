#include "graph/radix_sort.h"

#include "graph/prefix_sum.h"

#include <algorithm>

namespace bounce {

constexpr int64_t k_chunk = 256, k_row = 32768; // as in glsl/lib/radix_sort.comp

void describe_radix_sort(PassDescription& description, const std::string& pairs) {
    description.program("radix_sort", {"lib/radix_sort.comp"});
    description.bind("sort.pairs", pairs);
    for (const char* name : {"sort_stage", "sort_count", "sort_shift", "sort_half"})
        description.constant(name);
}

void declare_radix_sort(Declaration& d, const std::string& count) {
    d.creates_buffer("sort.pairs", "2 * max(" + count + ", 1)", 8).overwritten = true;
    d.uses("radix_sort");
}

std::string radix_sort_values(const std::string& count) {
    return "256 * ceil((" + count + ") / " + std::to_string(k_chunk) + ")";
}

int run_radix_sort(PassContext& c, int64_t count, int bits) {
    int64_t chunks = (count + k_chunk - 1) / k_chunk;
    int64_t across = std::min(chunks, k_row), up = (chunks + k_row - 1) / k_row;
    int half = 0;
    for (int shift = 0; shift < bits; shift += 8, half = 1 - half) {
        c.set("sort_count", int(count));
        c.set("sort_shift", shift);
        c.set("sort_half", half);
        for (int stage : {0, 1}) {
            c.set("sort_stage", stage);
            c.dispatch("radix_sort", {int(across) * 256, int(up), 1});
            c.barrier();
            if (stage == 0) run_prefix_sum(c, 256 * chunks);
        }
    }
    return half;
}

} // namespace bounce
