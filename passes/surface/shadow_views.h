#pragma once
// The views from which lights see the scene: one of a spot or directional light, six of a point light. Shadow maps and
// reflective shadow maps share them.

#include "graph/context.h"
#include "scene/scene.h"

#include <vector>

namespace bounce {

/// std430 mirror of glsl/lib/shadow.glsl. Depth is larger when nearer: near_plane / distance for perspective views,
/// whose near plane misses nothing (scene/near_plane.h); 1 − distance / range for orthographic ones (range > 0), where
/// what lies before the view is drawn at 1 and what lies beyond its range is not. 0 where nothing was drawn.
struct ShadowView {
    glm::mat4 view_projection{1};
    glm::vec3 origin{0};    ///< of the light; orthographic: on the near plane's centre
    float near_plane = 0;   ///< metres
    glm::vec3 direction{0}; ///< unit, the way the view looks
    float range = 0;        ///< metres; 0: perspective
    float texel_size = 0;   ///< perspective: metres at a distance of one metre; orthographic: metres
    float window = 1; ///< part of the map, 0 … window of its half width, that none of the light's other views shows
    float padding[2] = {};
};
static_assert(sizeof(ShadowView) == 112);

/// The views of all lights, in the order of the lights. `resolution` in texels; directional views are fitted to
/// `bounds`; what strays from these is lit there unless something inside of them blocks it.
std::vector<ShadowView> shadow_views(const std::vector<Light>& lights, const Bounds& bounds, int resolution);

/// How many there are: one of a spot or directional light, six of a point light.
int shadow_view_count(Declaration& declaration);
/// The views of this frame's lights.
std::vector<ShadowView> shadow_views(const PassContext& context, int resolution);

} // namespace bounce
