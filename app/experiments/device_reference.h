#pragma once
// A reference by the graph path_traced instead of the path tracer on the CPU: the same light transport and the same
// samples, where a GPU takes them faster. Needs a current OpenGL context.

#include "app/session.h"
#include "reference/reference_image.h"

namespace bounce {

/// The layers that reference_image() makes, but those of irradiance and occlusion, and its account of noise. `shown`
/// says which shot, at which size; `shot` is that shot. Samples are taken eight at a time. Nothing is kept for later
/// runs. Throws Error when the goal's part is none that light makes up.
LayeredImage device_reference(const SessionOptions& shown, const Shot& shot, const ReferenceSettings& settings,
                              int frame, const ReferenceGoal& goal,
                              const std::function<bool(const ReferenceProgress&)>& on_progress);

} // namespace bounce
