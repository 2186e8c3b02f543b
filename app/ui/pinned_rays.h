#pragma once
// Rays and cones that a debug view has recorded at a pixel, kept as they are in the scene: the camera may fly around
// them.

#include "app/ui/layout.h"
#include "app/ui/panel_context.h"

#include <optional>
#include <string>
#include <vector>

namespace bounce {

/// In loaded coordinates, as the camera.
struct PinnedRay {
    glm::vec3 end{0};
    float strength = 1; ///< 0 … 1: how much it counts beside the others
    bool hits = false;  ///< it ends at a surface, or is blocked
    float radius = 0;   ///< of a cone at its end
};

struct PinnedRays {
    std::string view; ///< the resource that shows them
    glm::vec3 origin{0};
    std::vector<PinnedRay> rays;
};

struct PinnedRayList {
    std::vector<PinnedRays> all;
};

/// What that view has recorded in the last frame; empty where it records none, or there was no surface. Stalls.
std::optional<PinnedRays> recorded_rays(const Graph& graph, const std::string& resource, float scene_diagonal);

/// Buttons that pin what the view records, and let go of all; nothing for a view that records no rays.
void draw_pin_buttons(PanelContext& context, const std::string& resource);

/// Lines over the picture into the current window: orange where they hit, blue where they do not.
void draw_pinned_rays(const PanelContext& context, const Area& picture);

} // namespace bounce
