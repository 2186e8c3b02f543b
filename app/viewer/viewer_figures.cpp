// Figures that belong to what is shown: when settings change, what was measured of the old ones does not count, and
// once nothing moves a few frames are rendered to measure the new ones.
#include "app/ui/settings_key.h"
#include "app/viewer/viewer_app.h"
#include "graph/model_values.h"

#include <imgui.h>
#include <limits>
#include <utility>

namespace bounce {

namespace {
constexpr double k_rest = 0.25;      ///< seconds without a change before it is measured,
constexpr double k_long_rest = 1.5;  ///< and where a frame is slow
constexpr double k_slow_frame = 500; ///< milliseconds
constexpr int k_wanted_runs = 3;     ///< of each pass
constexpr int k_most_frames = 8;     ///< that are rendered for it: queries come late
} // namespace

/// Before a frame.
void ViewerApp::follow_settings(double now) {
    std::string key = settings_key(*session_);
    if (key == settings_) return;
    settings_ = std::move(key);
    forget_figures(now);
}

/// After a frame: one in which something was planned or compiled costs more than those that follow.
void ViewerApp::follow_plan(double now) {
    planned_now_ = session_->graph().plans() != timed_plans_;
    if (!planned_now_) return;
    timed_plans_ = session_->graph().plans();
    settings_ = settings_key(*session_);
    forget_figures(now);
    first_run_ = true;
}

void ViewerApp::forget_figures(double now) {
    session_->graph().forget_timings();
    for (FrameTime& frame : ui_.frame_times)
        frame.current = false;
    changed_at_ = now;
    measured_ = 0;
    first_run_ = false;
}

/// When a frame is to be rendered in order to be measured, in seconds; infinity: none is.
double ViewerApp::next_measurement() const {
    const double never = std::numeric_limits<double>::infinity();
    const bool runs_anyway = !ui_.paused || ui_.render_always || ui_.window.capture.recording || options_.frames > 0;
    if (runs_anyway || ImGui::IsAnyItemActive() || ui_.redraw_frames > 0 || rendered_ == 0 ||
        measured_ >= k_most_frames)
        return never;
    const Graph& graph = session_->graph();
    const bool slow = !ui_.frame_times.empty() && ui_.frame_times.back().ms > k_slow_frame;
    const bool enough = slow ? times_are_current(graph) && !first_run_ : is_timed(graph) && measured_ >= k_wanted_runs;
    return enough ? never : changed_at_ + (slow ? k_long_rest : k_rest);
}

bool ViewerApp::time_to_measure(double now) {
    if (now < next_measurement()) return false;
    first_run_ = false;
    measuring_ = true;
    ++measured_;
    return true;
}

/// Returns whether it was rendered to its end.
bool ViewerApp::render_frame() {
    // What is measured runs also where its inputs have not changed.
    ParameterValue& rebuild = session_->graph().model().graph_parameters().find(k_rebuild)->value;
    const ParameterValue chosen = rebuild;
    if (std::exchange(measuring_, false)) rebuild = int(Rebuild::every_frame);
    BetweenPasses between;
    if (const BetweenPasses answer = between_passes()) {
        between = [&, answer](float done) {
            rebuild = chosen; // the graph asks for it when a frame begins; the panels show what a person chose
            return answer(done);
        };
    }
    bool whole = true;
    attempt([&] { whole = session_->render(false, between); });
    rebuild = chosen;
    finish_slow_frame();
    return whole;
}

} // namespace bounce
