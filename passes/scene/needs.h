#pragma once
// What a scene needs of a method, as numbers with their reasons: what the value "auto" of a parameter takes.

#include <map>
#include <string>

namespace bounce {

struct Need {
    double value = 0;
    std::string reason; ///< "a tenth of what is seen has surfaces within 0.9 m around it: 10 voxels across"
};

/// By name ("voxels", "cones"). A parameter says which one it follows (ParameterInfo::automatic).
using SceneNeeds = std::map<std::string, Need>;

} // namespace bounce
