#pragma once
// The digest of a pass's own inputs, without those that other passes make for it.

#include "core/revision.h"
#include "graph/allocations.h"
#include "graph/model.h"
#include "graph/pass_inputs.h"

namespace bounce {

struct FrameInputs;

/// Programs' text, parameters, the plan's shape, and of scene and frame what its programs use by reflection and what it
/// looked at on the CPU.
Revision digest_own_inputs(const GraphModel& model, const Plan& plan, const PlanPass& pass,
                           const Allocations& allocations, const FrameInputs& frame, const PassInputs& looked);
/// Whether a slot's resource is really used: by reflection, unless the slot is no shader's.
bool slot_is_active(const GraphModel& model, const PlanPass& pass, const PlanSlot& slot);
/// Whether a program of the pass reads previous_view_projection: it follows the camera's motion.
bool follows_camera(const GraphModel& model, const PlanPass& pass);

} // namespace bounce
