#pragma once
// Where a scene is, apart from what strays: one vertex or triangle far away must not set the size of a voxel.

#include "scene/scene.h"

#include <span>

namespace bounce {

/// World bounds with and without strays.
struct SceneExtent {
    Bounds bounds;                 ///< what grids, fitted views and lengths in diagonals go by
    Bounds whole;                  ///< of all geometry
    size_t triangles = 0;          ///< that are drawn
    size_t stray_triangles = 0;    ///< of them, wholly or partly outside for good
    size_t stray_moving_boxes = 0; ///< of moving parts, for some time
    bool strays() const { return stray_triangles > 0 || stray_moving_boxes > 0; }
};

/// The scene at `time`. Strays are
/// 1. triangles that span the bounds (an eighth of their longest edge) while all else would be smaller than a voxel of
/// a
///    grid of 256³: a third of the triangles at most;
/// 2. what lies so far out that the bounds without it are four times shorter, while they hold 99.99 % of the area and
/// of
///    what materials emit.
/// `views`: cameras that look at the scene; nothing is left out as stray if one of them then sees what is left as less
/// than a sixteenth of its picture. Where nothing strays, `bounds` is `whole`, to the bit.
SceneExtent scene_extent(const Scene& scene, float time, std::span<const Camera> views = {});

/// The same over the whole animation: the area of what moves counts by the share of moments for which it is somewhere.
/// 3. Moving parts also stray while they are eight times the size of the stage away from it (all geometry at the start)
///    if that would make the bounds 256 times longer, and if it is a third of the area and moments at most.
SceneExtent scene_extent_over_animation(const Scene& scene, std::span<const Camera> views = {});

/// The longest edge; 0 when empty.
float longest_edge(const Bounds& bounds);

} // namespace bounce
