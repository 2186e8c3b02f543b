#include "graph/prefix_sum.h"

#include <algorithm>

namespace bounce {

constexpr int64_t k_block = 2048, k_row = 32768; // as in glsl/lib/prefix_sum.comp

void describe_prefix_sum(PassDescription& description, const std::string& values) {
    description.program("prefix_sum", {"lib/prefix_sum.comp"});
    description.bind("prefix.values", values);
    description.bind("prefix.sums", values + "_sums");
    description.constant("prefix_stage");
    description.constant("prefix_count");
}

void declare_prefix_sum(Declaration& d, const std::string& count) {
    d.creates_buffer("prefix.values", "(" + count + ") + 1", 4).overwritten = true;
    d.creates_buffer("prefix.sums", "floor((" + count + ") / " + std::to_string(k_block) + ") + 1", 4).overwritten =
        true;
    d.uses("prefix_sum");
}

void run_prefix_sum(PassContext& c, int64_t count) {
    int64_t blocks = (count + 1 + k_block - 1) / k_block; // the total lies behind the last value, which counts as 0
    c.set("prefix_count", int(count + 1));
    for (int stage = 0; stage < 3; ++stage) {
        c.set("prefix_stage", stage);
        int64_t across = stage == 1 ? 1 : std::min(blocks, k_row), up = stage == 1 ? 1 : (blocks + k_row - 1) / k_row;
        c.dispatch("prefix_sum", {int(across) * 256, int(up), 1});
        c.barrier();
    }
}

} // namespace bounce
