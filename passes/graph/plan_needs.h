#pragma once
// What a plan asks of the driver's limits: samplers, image units, storage blocks and their sizes, work groups, shared
// memory, the sides of textures. Counted from the plan and the expanded text of its shaders, before anything is
// allocated or compiled.

#include "gpu/shader_needs.h"
#include "graph/model.h"

#include <string>
#include <vector>

namespace bounce {

struct PlanNeed {
    std::string pass; ///< of a resource the first that writes it
    std::string what; ///< "samplers in a compute shader", "layers of 'ldm.views'"
    std::string of;   ///< "ldm/build.comp"; of a resource nothing
    int64_t value = 0;
    GLenum limit = 0; ///< GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS
    int axis = 0;     ///< of limits that have three
};

/// Formats of the images that a pass stores to, for layout(FORMAT_slot), and HAS_slot for optional slots that something
/// fills: what would only feed a neutral value need not be compiled.
Defines pass_defines(const Plan& plan, const PlanPass& pass);

/// Of all passes, in order. The shaders' text is scanned as the plan has it. Needs of 0 are left out.
std::vector<PlanNeed> plan_needs(GraphModel& model, const Plan& plan);

/// Throws Error with every need that is above driver_limit(): pass, need, limit, and the parameter that lowers it where
/// one does. Works without a context, with limits that are pretended.
void check_plan_limits(GraphModel& model, const SceneFacts& facts, const Plan& plan);

/// The largest need by limit, and the pass that has it, beside the minimum of the specification: one line each.
std::string needs_text(const std::vector<PlanNeed>& needs);

} // namespace bounce
