#pragma once
// The camera by mouse and keys: fly, turn about a surface, slide, dolly. It knows nothing of windows: it is told what
// the pointer did over the picture.

#include "app/ui/panel_context.h"

namespace bounce {

/// What happened over the picture since the last frame.
struct CameraInput {
    bool hovered = false;                           ///< the pointer is over the picture
    bool look = false, turn = false, slide = false; ///< drags that began there
    glm::vec2 moved{0};                             ///< of the pointer, pixels of the picture
    glm::vec2 pixel{0}; ///< where it is, pixels of the picture ((0.5, 0.5): centre of the top left one)
    float wheel = 0;
    bool forward = false, back = false, left = false, right = false, up = false, down = false, fast = false;
    float seconds = 0; ///< since the last frame
};

class CameraControl {
  public:
    /// Moves the session's camera. Returns true when it did, or goes on moving.
    bool update(PanelContext& context, const CameraInput& input);

    /// The point that is turned about, while it is.
    const std::optional<glm::vec3>& pivot() const { return pivot_; }

  private:
    bool look(PanelContext& context, Camera& camera, const CameraInput& input);
    bool fly(const PanelContext& context, Camera& camera, const CameraInput& input);
    bool turn(Camera& camera, const CameraInput& input, glm::ivec2 size);
    bool slide(Camera& camera, const CameraInput& input, glm::ivec2 size);
    bool dolly(Camera& camera, const CameraInput& input, const glm::vec3& toward);

    std::optional<glm::vec3> pivot_;
};

/// The surface that the last picture shows at a pixel, from gbuffer.depth; where there is none, a point as far away as
/// the camera's target.
glm::vec3 point_under(const Session& session, glm::vec2 pixel);

/// A camera that sees the whole scene, looking as the present one does.
Camera camera_of_whole_scene(const Session& session);

} // namespace bounce
