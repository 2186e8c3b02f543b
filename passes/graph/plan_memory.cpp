#include "graph/plan_memory.h"

#include "core/log.h"
#include "core/memory.h"
#include "core/text.h"
#include "gpu/device_memory.h"
#include "graph/plan_needs.h"
#include "graph/plan_remedy.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

static std::string memory_remedy(GraphModel& model, const SceneFacts& facts, const Plan& plan) {
    const std::string remedy = plan_remedy(
        model, facts, plan, [](GraphModel&, const Plan& other) { return double(other.total_bytes()); },
        [](double bytes) { return format_bytes(bytes) + " in all"; });
    return remedy.empty() ? "use a smaller graph or scene" : remedy;
}

static std::string needs_of(const GraphModel& model, const Plan& plan) {
    if (plan.resources.empty()) return fmt::format("graph '{}' needs no memory of its own", model.file().name);
    const auto largest = std::max_element(plan.resources.begin(), plan.resources.end(),
                                          [](auto& a, auto& b) { return a.total_bytes() < b.total_bytes(); });
    return fmt::format("graph '{}' needs {} of memory at {}x{} ('{}' alone {})", model.file().name,
                       format_bytes(double(plan.total_bytes())), plan.size.x, plan.size.y, largest->name(),
                       format_bytes(double(largest->total_bytes())));
}

void check_plan_fits(GraphModel& model, const SceneFacts& facts, const Plan& plan, uint64_t held) {
    check_plan_limits(model, facts, plan);
    const double needed = double(plan.total_bytes()) - double(held);
    const DeviceMemory memory = device_memory();
    if (needed <= double(memory.free)) return;
    const std::string text =
        fmt::format("{}, but {} are free", needs_of(model, plan), format_bytes(double(memory.free)));
    // Main memory that is not there ends the program; a GPU's driver may find more than is free.
    if (memory.is_main) throw Error(text + ": " + memory_remedy(model, facts, plan));
    spdlog::warn("{} on the GPU: it may be slow, or fail; {}", text, memory_remedy(model, facts, plan));
}

std::string out_of_memory_text(GraphModel& model, const SceneFacts& facts, const Plan& plan, const std::string& what) {
    return fmt::format("{}: {}: {}", needs_of(model, plan), what, memory_remedy(model, facts, plan));
}

} // namespace bounce
