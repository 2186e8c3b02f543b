// Moves of the camera as steps of undo: from rest to rest.
#include "app/viewer/viewer_app.h"

#include <imgui.h>

namespace bounce {

namespace {

bool same(const std::optional<Camera>& a, const std::optional<Camera>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->position == b->position && a->target == b->target && a->up == b->up && a->vfov == b->vfov;
}

std::optional<Camera> set_camera_of(const Session& session) {
    return session.camera_is_set() ? std::optional(session.camera()) : std::nullopt;
}

} // namespace

/// Once it has rested, so that a flight is one step.
void ViewerApp::follow_camera(double now) {
    constexpr double k_rest = 0.3;
    const std::string shot = session_->shot().path.string();
    if (shot != rested_shot_) { // another one: what was done to the old is past
        rested_shot_ = shot;
        rested_camera_ = set_camera_of(*session_);
    }
    if (same(set_camera_of(*session_), rested_camera_)) {
        camera_moved_at_ = 0;
        return;
    }
    if (camera_moved_at_ == 0 || viewport_.busy() || ImGui::IsAnyItemActive()) camera_moved_at_ = now;
    if (now - camera_moved_at_ >= k_rest) note_camera();
}

void ViewerApp::note_camera() {
    const std::optional<Camera> before = rested_camera_, after = set_camera_of(*session_);
    if (same(before, after) || session_->shot().path.string() != rested_shot_) return;
    rested_camera_ = after;
    camera_moved_at_ = 0;
    const auto go = [this](const std::optional<Camera>& camera) {
        camera ? session_->set_camera(*camera, true) : session_->follow_shot_camera();
        rested_camera_ = camera;
        ui_.redraw();
    };
    undo_.push({"camera", [go, before] { go(before); }, [go, after] { go(after); }});
    gui_frames_ = std::max(gui_frames_, 1);
}

} // namespace bounce
