#pragma once
// The orthographic views of layered depth maps, fitted to the scene.

#include "scene/scene.h"

#include <vector>

namespace bounce {

/// std430 mirror of glsl/ldm/views.glsl. A world position x lies at texel (to_x·(x,1), to_y·(x,1)) of the map, texel
/// centres at .5, and at depth to_z·(x,1), 0 … 1 along the direction.
struct LdmView {
    glm::vec4 to_x{0}, to_y{0}, to_z{0};
    glm::vec3 direction{0, 0, 1}; ///< unit, the way the view looks
    float range = 1;              ///< metres of depth 0 … 1
    glm::vec2 texel{1};           ///< metres, across and up
    glm::vec2 padding{0};
};
static_assert(sizeof(LdmView) == 80);

/// std430 mirror of LdmInfo in glsl/ldm/views.glsl: how the maps of a batch lie in memory.
struct LdmInfo {
    int32_t maps, resolution, batches, slots, heads, node_words, capacity, arrays;
};

/// One view: `resolution`² texels over the box's outline, each side fitted for itself.
LdmView ldm_view(glm::vec3 direction, const Bounds& bounds, int resolution);

} // namespace bounce
