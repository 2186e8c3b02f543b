#pragma once
// Handles in the picture by which what is chosen (a light, a placed object) is dragged: its middle in the plane that
// faces the camera, along the axes of the file's coordinates, the end of its arrow, and the rim of its cone.

#include "app/ui/layout.h"
#include "app/ui/panel_context.h"

#include <array>
#include <functional>
#include <optional>

namespace bounce {

/// What is dragged, in the file's coordinates. A drag calls the functions of the target that was taken hold of, so they
/// may keep what it was then. Without its function a part is shown, but stays.
struct GizmoTarget {
    std::optional<glm::dvec3> position; ///< empty: it is anywhere, and shown in the middle of the view
    std::optional<glm::vec3> direction; ///< of its arrow, unit
    std::optional<float> cone;          ///< about the arrow: half-angle, radians
    std::function<void(const glm::dvec3& position)> move;
    std::function<void(const glm::vec3& direction)> turn;
    std::function<void(float cone)> open;
};

/// What ui.chosen_light or ui.chosen_object names (gizmo_target.cpp).
std::optional<GizmoTarget> gizmo_target(PanelContext& context);

class Gizmo {
  public:
    /// Draws the handles of gizmo_target() into the current window and follows the mouse. `pressed`: the button went
    /// down on the picture in this frame; `held`: it still is. Returns whether the mouse is the gizmo's.
    bool draw(PanelContext& context, const Area& picture, bool hovered, bool pressed, bool held);

  private:
    enum Handle { k_none = -1, k_middle, k_x, k_y, k_z, k_direction, k_cone, k_handles };
    struct Shape;

    int handle_under(const Shape& shape, const GizmoTarget& target, glm::vec2 mouse) const;
    void grab(Handle handle, const Shape& shape, const GizmoTarget& target, const glm::vec3& ray);
    void drag(const Shape& shape, const glm::vec3& ray) const;
    void draw_handles(const Shape& shape, int under) const;

    Handle held_ = k_none;
    GizmoTarget held_target_; ///< as it was when it was taken hold of
    glm::vec3 grabbed_{0};    ///< from where the mouse is to the target's place, in loaded coordinates
    float grabbed_cone_ = 0;  ///< from the angle under the mouse to the cone's
};

} // namespace bounce
