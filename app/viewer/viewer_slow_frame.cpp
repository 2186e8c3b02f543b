// A frame that takes its time is cut between its passes: events are taken and the panels drawn meanwhile. What would
// change the graph under the running frame waits for its end (UiState::after_frame).
#include "app/viewer/clock.h"
#include "app/viewer/viewer_app.h"

#include <algorithm>
#include <utility>

namespace bounce {

namespace {

constexpr double k_panel_interval = 1.0 / 30; ///< seconds between two drawings of the panels

/// The panels are drawn between two passes as long as it lives.
struct MidFrame {
    explicit MidFrame(UiState& of) : ui(of) { ui.mid_frame = true; }
    ~MidFrame() { ui.mid_frame = false; }
    MidFrame(const MidFrame&) = delete;
    MidFrame& operator=(const MidFrame&) = delete;
    UiState& ui;
};

} // namespace

/// Empty where nobody looks, or every frame counts.
BetweenPasses ViewerApp::between_passes() {
    if (is_scripted() || ui_.window.capture.recording || rendered_ == options_.simulate_reset) return {};
    frame_began_ = panels_drawn_ = seconds_now();
    frame_redraws_ = ui_.redraw_frames;
    return [this](float done) { return answer(done); };
}

/// Returns false where the rest of the frame is not wanted any more: the window is closed, or something moves and fewer
/// pixels will follow it sooner.
bool ViewerApp::answer(float done) {
    if (1000 * (seconds_now() - frame_began_) < k_slow_frame_ms && !is_slow()) return true;
    glFinish(); // else all of the frame would only be in the queue by now
    if (context_is_lost() || seconds_now() - panels_drawn_ < k_panel_interval) return true;
    const MidFrame mid_frame(ui_);
    ui_.frame_share = done;
    window_->poll_events();
    if (window_->take_activity() || viewport_.busy()) gui_frames_ = 4;
    attempt([&] { take_input(); });
    if (window_->framebuffer_size().x > 0) draw(true);
    panels_drawn_ = seconds_now();
    if (window_->should_close()) return false;
    // What is only held still asks for nothing new: a frame for it is rendered to its end.
    const bool moving =
        viewport_.busy() || (ImGui::IsAnyItemActive() && ui_.redraw_frames > std::max(frame_redraws_, 1));
    return !(moving && motion_share_ == 1 && motion_share(panels_drawn_) < 1);
}

void ViewerApp::finish_slow_frame() {
    for (const auto& action : std::exchange(ui_.after_frame, {}))
        attempt(action);
}

} // namespace bounce
