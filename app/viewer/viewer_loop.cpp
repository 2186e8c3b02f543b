// One turn of the loop: wait, handle events, render what changed.
#include "app/capture.h"
#include "app/ui/captures.h"
#include "app/ui/live_comparison.h"
#include "app/ui/open.h"
#include "app/ui/settings_key.h"
#include "app/ui/snapshots.h"
#include "app/ui/style.h"
#include "app/ui/timeline.h"
#include "app/viewer/clock.h"
#include "app/viewer/viewer_app.h"
#include "core/log.h"
#include "core/problem.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace bounce {

namespace {

constexpr double k_poll_interval = 0.2; ///< of watched files
constexpr double k_motion_rest = 0.3;   ///< after which the whole picture is rendered again
constexpr double k_settle_time = 0.15;  ///< of the viewport's size, before everything is allocated again
constexpr int k_max_resets = 5;         ///< of the GPU with fewer than so many frames between:
constexpr int k_good_frames = 100;
constexpr int k_max_attempts = 5;     ///< to make the window again
constexpr size_t k_kept_frames = 240; ///< of the history of frame times

/// Ctrl+C in the terminal closes the window as its button does, so that its state is kept.
volatile std::sig_atomic_t asked_to_quit = 0;
void on_signal(int) {
    asked_to_quit = 1;
}

} // namespace

void ViewerApp::run() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    ui_.make_gpu_again = [this] { make_gpu_again(); };
    ui_.note_camera = [this] { note_camera(); };
    ui_.redraw();
    while (!window_->should_close() && !asked_to_quit && !finished()) {
        wait();
        if (rendered_ == options_.simulate_reset && !std::exchange(reset_simulated_, true))
            pretend_reset(ResetCause::guilty);
        if (context_is_lost()) recover_from_reset();
        attempt([&] { handle_events(); });
        attempt([&] { take_input(); });
        double start = seconds_now();
        bool rendered = false;
        attempt([&] { rendered = render_if_wanted(); });
        bool visible = window_->framebuffer_size().x > 0;
        if (visible && (rendered || gui_frames_ > 0)) {
            draw(true);
            gui_frames_ = std::max(gui_frames_ - 1, 0);
            later_shown_ = true;
            keep_due_ = true;
        }
        if (rendered) {
            ui_.frame_times.push_back({float(1000 * (seconds_now() - start)), !planned_now_});
            if (motion_share_ == 1 && !planned_now_) whole_ms_ = ui_.frame_times.back().ms;
            if (ui_.frame_times.size() > k_kept_frames) ui_.frame_times.erase(ui_.frame_times.begin());
            if (!ui_.timeline) ui_.timeline = std::make_shared<Timeline>();
            attempt([&] {
                ui_.timeline->add(*session_, ui_.frame_times.back().ms, ui_.comparison.get(), settings_key(*session_));
            });
        }
    }
    if (!options_.capture_on_exit.empty()) write_picture(*session_, options_.capture_on_exit);
}

bool ViewerApp::finished() const {
    return options_.frames > 0 && rendered_ >= options_.frames;
}

void ViewerApp::wait() {
    bool visible = window_->framebuffer_size().x > 0;
    bool at_once = ui_.redraw_frames > 0 || ui_.render_always || ui_.window.capture.recording || ui_.single_step ||
                   options_.frames > 0 || !ui_.window.later.empty() || viewport_.busy() || (visible && gui_frames_ > 0);
    if (at_once) return window_->poll_events();
    double now = seconds_now();
    double until = next_poll_;
    if (!ui_.paused) until = std::min(until, next_play_);
    if (ui_.redraw_panels) until = std::min(until, now + 0.1);
    until = std::min(until, next_measurement());
    if (motion_share_ < 1) until = std::min(until, moved_at_ + k_motion_rest);
    if (fitting_.x > 0) until = std::min(until, fitting_since_ + k_settle_time);
    if (until <= now)
        window_->poll_events();
    else
        window_->wait_events(until - now);
}

/// Whatever goes wrong costs a line in the status bar and the log, never the program or the picture.
void ViewerApp::attempt(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& problem) {
        std::string text = problem_text(problem);
        if (text != ui_.notice) { // not once a frame
            spdlog::error("{}", text);
            gui_frames_ = 4;
        }
        ui_.say(text, true);
    }
}

void ViewerApp::handle_events() {
    if (window_->take_activity() || viewport_.busy() || ImGui::IsAnyItemActive()) gui_frames_ = 4;
    if (std::exchange(ui_.redraw_panels, false)) gui_frames_ = std::max(gui_frames_, 1);
    if (window_->take_scale_change()) attempt([&] { make_interface(); });
    PanelContext panels = context();
    for (const std::string& path : window_->take_dropped_files())
        ask_for_file(panels, path);
    run_later_actions();
    double now = seconds_now();
    follow_camera(now);
    if (now < next_poll_) return;
    next_poll_ = now + k_poll_interval;
    // At rest: neither a drag nor a flight is written step by step.
    if (keep_due_ && !is_scripted() && !ImGui::IsAnyItemActive() && !viewport_.busy()) {
        keep_due_ = false;
        attempt([&] {
            if (session_->measure_moved_needs()) ui_.redraw();
        });
        attempt([&] { keep_state(); });
    }
    // A reference that grows in the background, and the flicker between it and the picture, are seen without input.
    const LiveComparison* comparison = ui_.comparison.get();
    bool moving = comparison && (comparison->running() || comparison->view == CompareView::flicker);
    if (moving) gui_frames_ = std::max(gui_frames_, 1);
    attempt([&] {
        if (session_->poll_files()) ui_.redraw();
    });
}

/// Each step of what a person did gets a frame of the panels, one after another; what they change is rendered once.
void ViewerApp::take_input() {
    if (window_->framebuffer_size().x <= 0) window_->drop_input();
    if (!ui_.mid_frame) keys_.insert(keys_.begin(), waiting_keys_.begin(), waiting_keys_.end()), waiting_keys_.clear();
    for (;;) {
        for (const KeyPress& key : std::exchange(keys_, {}))
            run_command(key);
        if (!window_->has_input()) return;
        draw(false);
    }
}

void ViewerApp::run_later_actions() {
    if (ui_.window.later.empty()) {
        later_shown_ = false;
        return;
    }
    if (!later_shown_) {
        gui_frames_ = std::max(gui_frames_, 2); // first show what will be done
        if (window_->framebuffer_size().x > 0) return;
    }
    later_shown_ = false;
    for (const auto& action : std::exchange(ui_.window.later, {}))
        attempt(action);
    gui_frames_ = 4;
}

bool ViewerApp::time_to_advance() {
    if (std::exchange(ui_.single_step, false)) {
        ui_.paused = true;
        return true;
    }
    if (ui_.window.capture.recording) return ui_.window.capture.written > 0;
    if (ui_.paused) return false;
    // Playing keeps the shot's pace where the machine can; where it cannot, no frame is left out.
    double now = seconds_now();
    if (now < next_play_) return false;
    double interval = 1.0 / double(session_->shot().fps);
    next_play_ = next_play_ + interval < now ? now + interval : next_play_ + interval;
    return true;
}

/// How much of the picture's width and height is rendered: where a frame at the whole size is slow, less while a person
/// moves something, so that the picture follows; the whole again when it has rested for a while.
float ViewerApp::motion_share(double now) {
    constexpr float k_wanted = 50; // milliseconds
    const bool moving = viewport_.busy() || (ImGui::IsAnyItemActive() && ui_.redraw_frames > 0);
    const bool wanted = ui_.window.coarse_while_moving && ui_.window.sizing.fit && !ui_.window.capture.recording &&
                        !is_scripted() && whole_ms_ > k_slow_frame_ms;
    if (moving) moved_at_ = now;
    if (!wanted || now - moved_at_ > k_motion_rest) return 1;
    if (motion_share_ < 1) return motion_share_; // one size for a whole motion
    const float share = std::sqrt(k_wanted / whole_ms_);
    return share > 0.6f ? 0.75f : share > 0.35f ? 0.5f : 0.25f;
}

void ViewerApp::fit_picture() {
    const PictureSizing& sizing = ui_.window.sizing;
    glm::vec2 whole(session_->shot().width, session_->shot().height);
    if (sizing.fit) {
        float scale = window_->content_scale() * ui_.window.interface_scale;
        glm::ivec2 display = window_->size();
        Areas areas = arrange(ui_.window.layout, {float(display.x), float(display.y)}, scale);
        whole = glm::vec2(areas.viewport.size.x, areas.viewport.size.y) * window_->pixel_ratio();
    } else if (sizing.fixed.x > 0 && sizing.fixed.y > 0) {
        whole = glm::vec2(sizing.fixed);
    }
    const double now = seconds_now();
    const float share = motion_share(now);
    const bool motion = share != motion_share_;
    motion_share_ = share;
    glm::ivec2 size =
        glm::clamp(glm::ivec2(glm::round(whole * sizing.scale * share)), glm::ivec2(1), glm::ivec2(16384));
    if (size == session_->size()) {
        fitting_ = glm::ivec2(0);
        return;
    }
    if (size != fitting_) {
        fitting_ = size;
        fitting_since_ = now;
    }
    // While a border is dragged, the picture is stretched; it is made anew when the size has settled.
    if (rendered_ > 0 && sizing.fit && !motion && now - fitting_since_ < k_settle_time) return;
    fitting_ = glm::ivec2(0);
    session_->resize(size);
    ui_.redraw();
}

/// Returns whether a frame was rendered to its end.
bool ViewerApp::render_if_wanted() {
    if (window_->framebuffer_size().x > 0) fit_picture();
    bool advance = time_to_advance();
    bool wanted = advance || ui_.redraw_frames > 0 || ui_.render_always || ui_.window.capture.recording ||
                  options_.frames > 0 || time_to_measure(seconds_now());
    if (!wanted) return false;
    // While time plays, a frame that was left for a motion of the camera is rendered before the next.
    if (advance && (session_->is_whole() || ui_.paused)) session_->advance();
    ui_.redraw_frames = std::max(ui_.redraw_frames - 1, 0);
    return render();
}

bool ViewerApp::render() {
    follow_settings(seconds_now());
    if (!render_frame()) {
        ui_.redraw();
        return false;
    }
    follow_plan(seconds_now());
    ++rendered_;
    tell_problems();
    PanelContext panels = context();
    if (ui_.window.capture.recording) attempt([&] { record_frame(panels); });
    return true;
}

/// Of the last frame.
bool ViewerApp::is_slow() const {
    return !ui_.frame_times.empty() && ui_.frame_times.back().ms > k_slow_frame_ms;
}

/// Says once when shaders or the graph break, and when they are whole again.
void ViewerApp::tell_problems() {
    std::string text;
    for (const GraphProblem& problem : session_->graph().problems())
        text += problem.error.text() + "\n";
    if (text == problems_) return;
    if (text.empty())
        ui_.say("everything compiles again");
    else
        ui_.say(text, true);
    problems_ = text;
    gui_frames_ = 4;
}

/// What the driver is doing after a reset may take it a while.
void ViewerApp::recover_from_reset() {
    if (rendered_ - last_reset_ > k_good_frames) resets_ = 0;
    last_reset_ = rendered_;
    if (++resets_ > k_max_resets)
        throw Error(fmt::format("the GPU was reset {} times in a row, whatever was disabled: the window is closed",
                                k_max_resets));
    spdlog::warn("{}: the window and everything on the GPU are made again", to_string(context_reset()));
    for (int attempt = 1;; ++attempt) {
        try {
            make_gpu_again();
            break;
        } catch (const std::exception& problem) {
            spdlog::error("{}", problem_text(problem));
            if (attempt == k_max_attempts) throw;
            std::this_thread::sleep_for(std::chrono::seconds(attempt));
        }
    }
    ui_.say("the GPU was reset, and everything on it was made again", true);
}

void ViewerApp::make_gpu_again() {
    session_->release_gpu();
    viewport_.release_gpu();
    if (ui_.comparison) ui_.comparison->release_gpu();
    ui_.cones.reset();
    ui_.nodes.reset();
    if (ui_.snapshots) ui_.snapshots->release_gpu();
    window_->make_again();
    make_interface();
    session_->restore_gpu();
    ui_.redraw();
    gui_frames_ = 4;
}

} // namespace bounce
