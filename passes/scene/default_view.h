#pragma once
// Where to look from when nobody says.

#include "scene/scene.h"

namespace bounce {

enum class ViewKind {
    outside,  ///< an object: looked at from outside
    open_box, ///< a room with one open side (a Cornell box): looked into from there
    inside,   ///< a building: looked through along its longest free view
};

struct DefaultView {
    Camera camera;
    ViewKind kind = ViewKind::outside;
    float sky_share = 1; ///< of the upper hemisphere, seen from the middle: whether sunlight gets in
};

/// Decides by rays through a coarse grid from the middle of the bounds: those that meet surfaces turned toward them are
/// inside something. Deterministic. `aspect` = width ÷ height.
DefaultView default_view(const Scene& scene, float aspect);

/// The camera that frames `bounds` when looking along unit `direction`.
Camera framing_camera(const Bounds& bounds, const glm::vec3& direction, float vfov, float aspect);

} // namespace bounce
