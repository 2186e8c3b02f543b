#pragma once
// A graph's passes as the graph panel lists them, and resources in words.

#include "graph/model.h"

#include <string>
#include <vector>

namespace bounce {

struct PassRow {
    std::string id;
    int plan = -1;       ///< index into Plan::passes; −1: it does not run
    std::string skipped; ///< why
};
/// Plan order; a pass that does not run stands behind the one that it follows in the graph file, so that rows keep
/// their place when a pass is switched off.
std::vector<PassRow> pass_rows(const GraphModel& model, const Plan& plan);

/// The texture that stands for a pass: the first out.* that it writes, else the first texture; "" when it writes none.
std::string main_output(const Plan& plan, const PlanPass& pass);

/// Everything that the plan says of a pass: what it reads and writes with formats, sizes and bytes, barriers, steps.
std::string pass_details(const GraphModel& model, const Plan& plan, const PlanPass& pass);

/// "320×180", "64×64, 6 layers", "64³", "12,000 × 16 B".
std::string size_text(const PlanResource& resource);
/// "rgba16f 320×180, 5 mips, 1.2 MiB".
std::string resource_text(const PlanResource& resource);

} // namespace bounce
