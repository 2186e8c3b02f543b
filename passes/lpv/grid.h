#pragma once
// std430 mirrors of glsl/lpv/grid.glsl and light.glsl, and where the cascades lie.

#include "scene/scene.h"

#include <cstdint>
#include <glm/glm.hpp>

namespace bounce {

/// One grid of cells³ cells.
struct LpvCascade {
    glm::vec3 anchor{0}; ///< metres: a corner of a cell, the same in every frame
    float cell = 1;      ///< side of a cell, metres
    glm::ivec3 base{0};  ///< the first cell, counted from the anchor
    int32_t padding = 0;
};
static_assert(sizeof(LpvCascade) == 32);

inline constexpr int k_most_lpv_cascades = 4;

/// Nested cascades, the finest first; each is twice as wide as the one before.
struct LpvGrid {
    int32_t cells = 32;   ///< along each side of a cascade
    int32_t cascades = 1; ///< at most k_most_lpv_cascades
    int32_t follows = 0;  ///< 1: the outermost follows the camera, too
    int32_t padding = 0;
    LpvCascade cascade[k_most_lpv_cascades];
};
static_assert(sizeof(LpvGrid) == 144);

/// How the cascades lie about a camera.
struct LpvPlacement {
    int cells = 32, cascades = 1;
    bool follow = false; ///< the outermost cascade follows the camera; else it holds the scene and stands still
    float extent = 1;    ///< its width as a share of the grid that holds the scene
    float ahead = 0.6f;  ///< how far middles lie before the camera, as a share of half their width
};
/// The cascades of a camera at `position` that looks along `forward` (unit). All move by whole cells.
LpvGrid lpv_grid(const LpvPlacement& placement, const Bounds& scene, glm::vec3 position, glm::vec3 forward);

/// A virtual point light.
struct LpvVpl {
    glm::vec3 normal;
    float share;         ///< ordinates: makes the sum over all directions what the lobe's integral is
    glm::vec3 intensity; ///< W/sr along the normal
    float padding;
};
static_assert(sizeof(LpvVpl) == 32);

/// A cell's light: a column a colour, (c_00, c_1x, c_1y, c_1z); W/(sr·m²), per area of a cell's face.
using LpvLight = glm::mat3x4;
static_assert(sizeof(LpvLight) == 48);

} // namespace bounce
