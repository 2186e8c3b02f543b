#pragma once
// The middle of the window: the chosen texture, the pixel under the pointer, and the camera's mouse.

#include "app/ui/camera_control.h"
#include "app/ui/gizmo.h"
#include "app/ui/layout.h"
#include "app/ui/texture_view.h"

namespace bounce {

class Window;

class Viewport {
  public:
    /// Draws into the area and handles the mouse over it. Shader errors of the texture view are shown in the place of
    /// the picture.
    void draw(PanelContext& context, const Area& area, Window& window);
    /// The camera is on its way: the next frame must not wait for an event.
    bool busy() const { return busy_; }
    /// What belongs to the context, which is about to be lost or gone.
    void release_gpu();

  private:
    const GpuTexture* texture_to_show(PanelContext& context);
    bool draw_snapshots(PanelContext& context, const Area& picture);
    void note_viewed(const GpuTexture& source, const ViewerSettings& settings);
    Area place_picture(const PanelContext& context, const Area& area, glm::vec2 texels) const;
    void zoom(PanelContext& context, const Area& area, const Area& picture) const;
    void follow_pointer(PanelContext& context, const Area& picture, bool hovered) const;
    void move_camera(PanelContext& context, const Area& picture, bool hovered, bool active, bool pressed,
                     Window& window);
    void overlay(PanelContext& context, const Area& area, const Area& picture) const;

    std::unique_ptr<TextureView> view_;
    ViewerSettings shown_;             ///< of the last draw
    std::string failure_;              ///< why there is no picture
    const GpuTexture* pair_ = nullptr; ///< what is compared, of the comparison
    std::string caption_;              ///< what is compared, when a comparison is shown
    uint64_t drawn_frame_ = ~0ull;
    GLuint drawn_texture_ = 0;
    CameraControl control_;
    Gizmo gizmo_;
    int drag_button_ = -1; ///< of ImGui: 0 left, 1 right, 2 middle
    bool busy_ = false;
};

} // namespace bounce
