#pragma once
// What a reference must compute to be of the same light transport as a graph, occlusion included.

#include "graph/model.h"
#include "reference/settings.h"

#include <string>
#include <vector>

namespace bounce {

/// The graph's bounces and materials, and d_max and falloff of its occlusion by the present values of the parameters
/// that its transport names. Throws Error when they mean nothing to the reference.
ReferenceSettings transport_settings(const GraphModel& model);

/// Throws Error naming the nearest.
OcclusionFalloff occlusion_falloff(const std::string& name);

/// Whether all of these parts are shares of an open hemisphere: they have units of their own (AO units), in which
/// errors are told absolutely, and no bounces.
bool only_occlusion(const std::vector<std::string>& parts);

/// Names what is compared: errors of different light are no points of one front. "1 bounce: indirect_diffuse",
/// "all light: radiance".
std::string transport_text(int bounces, const std::vector<std::string>& parts);
/// The parts of a sum without their "out.": "direct + emission".
std::string parts_text(const std::vector<std::string>& parts);

} // namespace bounce
