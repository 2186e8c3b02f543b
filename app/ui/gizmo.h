#pragma once
// Handles in the picture by which the chosen light is dragged: its middle in the plane that faces the camera, along the
// axes of the file's coordinates, and the end of the arrow that tells which way it shines.

#include "app/ui/layout.h"
#include "app/ui/panel_context.h"

#include <array>

namespace bounce {

class LightGizmo {
  public:
    /// Draws the handles of ui.chosen_light into the current window and follows the mouse. `pressed`: the button went
    /// down on the picture in this frame; `held`: it still is. Returns whether the mouse is the gizmo's.
    bool draw(PanelContext& context, const Area& picture, bool hovered, bool pressed, bool held);

  private:
    enum Handle { k_none = -1, k_middle, k_x, k_y, k_z, k_direction, k_handles };

    Handle held_ = k_none;
    glm::vec3 grabbed_{0}; ///< from where the mouse is to the light's place, in loaded coordinates
};

} // namespace bounce
