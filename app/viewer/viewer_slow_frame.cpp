// A frame that takes its time is cut between its passes: events are taken and the panels drawn meanwhile. What would
// change the graph under the running frame waits for its end (UiState::after_frame).
#include "app/viewer/viewer_app.h"

#include <chrono>
#include <utility>

namespace bounce {

namespace {

double seconds_now() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

constexpr double k_panel_interval = 1.0 / 30; ///< seconds between two drawings of the panels
constexpr double k_slow = 0.1;                ///< seconds from which on a frame is cut

} // namespace

/// Empty where nobody looks, or every frame counts.
BetweenPasses ViewerApp::between_passes() {
    if (is_scripted() || ui_.window.capture.recording || rendered_ == options_.simulate_reset) return {};
    frame_began_ = panels_drawn_ = seconds_now();
    return [this](size_t done) { return answer(done); };
}

/// Returns false where the rest of the frame is not wanted any more: the window is closed, or something moves and fewer
/// pixels will follow it sooner.
bool ViewerApp::answer(size_t passes_done) {
    if (seconds_now() - frame_began_ < k_slow && !is_slow()) return true;
    glFinish(); // else all of the frame would only be in the queue by now
    if (context_is_lost() || seconds_now() - panels_drawn_ < k_panel_interval) return true;
    ui_.mid_frame = true;
    ui_.frame_share = float(passes_done + 1) / float(session_->graph().plan().passes.size());
    window_->poll_events();
    if (window_->take_activity() || viewport_.busy()) gui_frames_ = 4;
    attempt([&] { take_input(); });
    if (window_->framebuffer_size().x > 0) draw(true);
    ui_.mid_frame = false;
    panels_drawn_ = seconds_now();
    if (window_->should_close()) return false;
    return !(motion_share_ == 1 && motion_share(panels_drawn_) < 1);
}

void ViewerApp::finish_slow_frame() {
    for (const auto& action : std::exchange(ui_.after_frame, {}))
        attempt(action);
}

} // namespace bounce
