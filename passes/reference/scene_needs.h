#pragma once
// The needs of a shot (scene/needs.h), from what is measured in it.

#include "reference/feature_sizes.h"
#include "scene/needs.h"

namespace bounce {

/// The rules. `extent`: the longest edge of the scene's bounds, metres.
SceneNeeds needs_of(const FeatureSizes& features, float extent);
/// Measures the shot and applies the rules.
SceneNeeds scene_needs(const Shot& shot);

} // namespace bounce
