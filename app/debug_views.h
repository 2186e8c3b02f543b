#pragma once
// What can be looked at inside a graph beside its picture: the passes that draw its structures.

#include "graph/model.h"

#include <string>
#include <vector>

namespace bounce {

struct DebugView {
    std::string pass;     ///< that draws it; most are off until they are asked for
    std::string resource; ///< "debug.voxels", a texture
    std::string name;     ///< "voxels"
    std::string about;    ///< what it shows, as the head of its shader says
};

/// In the order of the graph file. What only feeds another view is none.
std::vector<DebugView> debug_views(const GraphModel& model, const SceneFacts& facts, glm::ivec2 size);

/// The comment at the head of a shader, in one line; empty: there is none.
std::string shader_about(const std::string& text);

} // namespace bounce
