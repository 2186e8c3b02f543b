#pragma once
// The light of a shot that a graph leaves out, as its transport states: what scatters light of emissive surfaces has
// the part out.emitted, what scatters that of the environment out.environment.

#include "graph/graph_file.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace bounce {

/// Of the kinds of light that the scene holds, those that the graph scatters nowhere: "light of the environment", …
/// Nothing of graphs that model no scattering, or all of it (out.radiance).
std::vector<std::string> omitted_light(const Transport& transport, const SceneFacts& facts);

/// Tells it on the log, the same once per process.
void log_omitted_light(const std::string& graph, const Transport& transport, const SceneFacts& facts);

/// The same of all graphs in assets/graphs, for `bounce info`: a line for each kind of light. Lines end with '\n'.
std::string describe_omitted_light(const SceneFacts& facts);

} // namespace bounce
