#include "app/viewer/viewer_app.h"
#include "app/ui/live_comparison.h"

#include "app/capture.h"
#include "app/ui/captures.h"
#include "app/ui/open.h"
#include "app/ui/style.h"
#include "app/ui/ui_state_file.h"
#include "app/ui/widget_rects.h"
#include "app/ui/work.h"
#include "core/log.h"
#include "core/problem.h"
#include "core/text.h"

namespace bounce {

ViewerApp::ImGuiLife::ImGuiLife() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // the window's state is kept in a file of ours
    io.ConfigWindowsMoveFromTitleBarOnly = true;
}

ViewerApp::ImGuiLife::~ImGuiLife() {
    ImGui::DestroyContext();
}

ViewerApp::ViewerApp(ViewOptions options) : options_(std::move(options)) {
    ui_.window = load_window_state();
    WindowState& state = ui_.window;
    if (!options_.shot_given && !state.shot.empty()) options_.session.shot = state.shot;
    if (!options_.graph_given && !state.graph.empty()) options_.session.graph = state.graph;
    if (options_.session.size) {
        state.sizing = {false, 1, *options_.session.size};
    }
    if (!options_.dump_ui.empty()) start_widget_dump(options_.dump_ui);
    if (!options_.capture_on_exit.empty()) check_output_path(options_.capture_on_exit);

    WindowOptions wanted;
    wanted.size = options_.window_size.value_or(state.size);
    wanted.maximized = state.maximized && !options_.window_size;
    window_ = std::make_unique<Window>(wanted);
    make_interface();
    splash("opening " + options_.session.shot + " …");
    open_session();
    spdlog::debug("{}", describe(window_->capabilities()));
    state.opened = baseline_of(*session_);
    if (!is_scripted()) restore_work();
}

ViewerApp::~ViewerApp() {
    if (window_ && session_) keep_state();
    if (session_ && ui_.window.capture.recording) { // a film of what was recorded so far
        PanelContext panels = context();
        attempt([&] { stop_recording(panels); });
    }
    viewport_.release_gpu();
    ui_.comparison.reset();
    ui_.cones.reset();
    ui_.nodes.reset();
    ui_.snapshots.reset();
    session_.reset();
}

void ViewerApp::make_interface() {
    float scale = window_->content_scale() * ui_.window.interface_scale;
    apply_style(scale);
    load_fonts(scale, window_->pixel_ratio());
    window_->make_font_texture();
}

/// A first frame, since a large scene takes seconds.
void ViewerApp::splash(const std::string& text) {
    // Some window managers map a window only after a while: what is drawn before is lost.
    for (int i = 0; i < 2; ++i) {
        window_->poll_events();
        window_->begin_frame();
        ImVec2 display = ImGui::GetIO().DisplaySize, size = ImGui::CalcTextSize(text.c_str());
        ImVec2 at{0.5f * (display.x - size.x), 0.5f * (display.y - size.y)};
        ImGui::GetForegroundDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
        window_->end_frame();
    }
}

void ViewerApp::open_session() {
    // What the last run left behind may be gone: then the window opens on what is always there.
    bool remembered = (!options_.shot_given && options_.session.shot != k_default_shot) ||
                      (!options_.graph_given && options_.session.graph != k_default_graph);
    try {
        session_ = std::make_unique<Session>(options_.session);
    } catch (const std::exception& problem) {
        if (!remembered) throw;
        std::string text = "the last shot or graph cannot be opened again: " + problem_text(problem);
        spdlog::warn("{}", text);
        ui_.say(text, true);
        if (!options_.shot_given) options_.session.shot = k_default_shot;
        if (!options_.graph_given) options_.session.graph = k_default_graph;
        session_ = std::make_unique<Session>(options_.session);
    }
}

/// What was edited when the program last ended, however it did.
void ViewerApp::restore_work() {
    std::set<std::string> given;
    for (const auto& [name, text] : options_.session.sets)
        given.insert(name);
    for (const auto& [pass, on] : options_.session.switches)
        given.insert(pass);
    PanelContext panels = context();
    std::vector<std::string> restored;
    for (const std::string& part : {restore_shot_work(panels), restore_graph_work(panels, given)})
        if (!part.empty()) restored.push_back(part);
    if (restored.empty() || ui_.notice_is_error) return;
    ui_.say("your edits of last time are here again: " + join(restored, "; ") +
            " (F5, \"reset all\": as in the files)");
}

/// Writes what outlives the program, if it changed.
void ViewerApp::keep_state() {
    WindowState& window = ui_.window;
    window.shot = session_->options().shot;
    window.graph = session_->options().graph;
    window.maximized = window_->maximized();
    if (!window.maximized && window_->size().x > 0) window.size = window_->size();
    PanelContext panels = context();
    if (!is_scripted()) keep_work(panels);
    const PictureSizing sizing = window.sizing;
    if (options_.session.size) window.sizing = {}; // what a command line fixed was meant for that run
    std::string text = window_state_text(window);
    window.sizing = sizing;
    if (text == kept_state_) return;
    kept_state_ = std::move(text);
    save_window_state(kept_state_);
}

} // namespace bounce
