#pragma once
// Which settings a figure belongs to.

#include "app/session.h"

namespace bounce {

/// Names all that a person can set of what the next frame shows and costs: shot and its edits, camera, size, graph,
/// values, switches, shaders. The passing of time is no setting.
std::string settings_key(const Session& session);

/// Whether the time of every pass is one of the present settings: measured since they were made, or of a pass that none
/// of them reaches.
bool times_are_current(const Graph& graph);

/// Whether every pass has run and been timed since they were made.
bool is_timed(const Graph& graph);
/// Milliseconds of a frame in which every pass runs, as charts and tables measure: the sum of the medians, or of the
/// last run where there was none since the settings were made.
double whole_frame_ms(const Graph& graph);

} // namespace bounce
