#pragma once
// Where lights are and which way they shine, in the file's coordinates, and lights that come and go. All steps can be
// undone.

#include "app/ui/panel_context.h"

#include <optional>

namespace bounce {

struct LightPlace {
    glm::dvec3 position{0};
    glm::vec3 direction{0, -1, 0}; ///< unit, the way the light travels
};

/// Index of the node that places a light; −1: none, it shines nowhere.
int node_of_light(const Scene& scene, size_t light);

/// Empty where no node places it.
std::optional<LightPlace> place_of_light(const Session& session, size_t light);

/// Whether a path or an animation moves it, so that a person cannot.
bool is_driven(const Scene& scene, size_t light);

/// Moves the node so that its light is there; its parent stays. From press to release is one step of undo. Nothing
/// for a light that is driven or that no node places.
void move_light(PanelContext& context, size_t light, const LightPlace& place);

/// Gives a spot, which was `before` when the step began, that outer cone (half-angle in radians, limited to what shots
/// hold); the inner one keeps its share of it.
void open_cone(PanelContext& context, size_t light, const Light& before, float outer_cone);

/// A light in front of the camera (a directional one shines along the view), as bright as the scene's size asks for.
/// It becomes the chosen one.
void add_light(PanelContext& context, LightType type);
/// A light at the camera that shines along the view.
void add_headlight(PanelContext& context);
/// The same light once more, a little to the side.
void duplicate_light(PanelContext& context, size_t light);
void delete_light(PanelContext& context, size_t light);

} // namespace bounce
