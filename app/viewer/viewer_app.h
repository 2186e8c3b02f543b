#pragma once
// The program with a window: one loop that handles events, renders when something changed, and draws the panels.

#include "app/hosts/window.h"
#include "app/ui/keys.h"
#include "app/ui/viewport.h"
#include "app/viewer/palette.h"

namespace bounce {

struct ViewOptions {
    SessionOptions session;
    bool shot_given = false, graph_given = false; ///< else those of the last run
    std::optional<glm::ivec2> window_size;        ///< else that of the last run
    int frames = 0;                               ///< quit after so many rendered frames; 0: when the window is closed
    std::string capture_on_exit;                  ///< a .png or .exr
    std::string dump_ui;                          ///< see widget_rects.h
    int simulate_reset = -1; ///< act as if the GPU had been reset, when so many frames are rendered
};

class ViewerApp {
  public:
    /// Opens the window, the shot and the graph. Throws Error.
    explicit ViewerApp(ViewOptions options);
    ~ViewerApp();
    /// Until the window is closed. Throws Error only when nothing can be shown any more.
    void run();

  private:
    struct ImGuiLife { ///< before the window is made, and after it is gone
        ImGuiLife();
        ~ImGuiLife();
    };

    PanelContext context() { return {*session_, ui_, undo_}; }
    void make_interface();
    void splash(const std::string& text);
    void open_session();
    void restore_work();
    void keep_state();
    /// It runs by itself and quits: what a person left does not reach it, and it leaves nothing.
    bool is_scripted() const { return options_.frames > 0 || !options_.capture_on_exit.empty(); }

    // viewer_loop.cpp: one turn of the loop
    void wait();
    void handle_events();
    void take_input();
    void attempt(const std::function<void()>& action);
    void run_later_actions();
    bool render_if_wanted();
    bool time_to_advance();
    void fit_picture();
    float motion_share(double now);
    void follow_camera(double now);
    void note_camera();
    bool render();
    bool is_slow() const;
    void tell_problems();
    void recover_from_reset();
    void make_gpu_again();
    bool finished() const;

    // viewer_figures.cpp: times belong to the settings that made them
    void follow_settings(double now);
    void follow_plan(double now);
    void forget_figures(double now);
    double next_measurement() const;
    bool time_to_measure(double now);
    bool render_frame();

    // viewer_slow_frame.cpp: the panels answer while a frame takes its time
    BetweenPasses between_passes();
    bool answer(float done);
    void finish_slow_frame();

    // viewer_draw.cpp
    /// A frame of the panels; one that is not `shown` only takes input.
    void draw(bool shown);
    void take_keys();
    void draw_panels(PanelContext& panels, const Areas& areas);
    void draw_keys_window(PanelContext& panels);

    // viewer_commands.cpp
    void run_command(const KeyPress& key);
    void handle_time(KeyCommand command);
    void handle_camera(KeyCommand command, const std::string& chord);
    void handle_files(KeyCommand command);
    void handle_window(KeyCommand command);

    ViewOptions options_;
    UiState ui_;
    UndoStack undo_;
    ImGuiLife imgui_;
    std::unique_ptr<Window> window_;
    std::unique_ptr<Session> session_;
    Viewport viewport_;
    Palette palette_;

    std::vector<KeyPress> keys_;         ///< of this frame
    std::vector<KeyPress> waiting_keys_; ///< for the end of the frame that is being rendered
    std::string kept_state_;             ///< as it was written last
    bool keep_due_ = false;              ///< something was drawn since

    int gui_frames_ = 4;       ///< still to be drawn: ImGui settles over a few
    bool later_shown_ = false; ///< the notice of what run_later_actions() will do has been on the screen
    double next_poll_ = 0, next_play_ = 0;
    glm::ivec2 fitting_{0}; ///< a size that the picture is to have, once it has stayed so
    double fitting_since_ = 0;
    float motion_share_ = 1;                    ///< of the width: less while something moves on a slow machine
    float whole_ms_ = 0;                        ///< of the last frame at the whole size in which nothing was planned
    double moved_at_ = -1;                      ///< when something moved last
    double frame_began_ = 0, panels_drawn_ = 0; ///< of the frame that is being rendered
    int frame_redraws_ = 0; ///< UiState::redraw_frames when it began: more are of something that changed since

    std::optional<Camera> rested_camera_; ///< that undo goes back to; empty: the shot's
    std::string rested_shot_;             ///< of which it is
    double camera_moved_at_ = 0;          ///< 0: it is at rest
    int rendered_ = 0;
    std::string settings_;     ///< of the last frame
    uint64_t timed_plans_ = 0; ///< Graph::plans() then
    double changed_at_ = 0;    ///< when they changed last
    int measured_ = 0;         ///< frames that were rendered to be measured since
    bool measuring_ = false;   ///< the next frame is one of them
    bool first_run_ = false;   ///< what was measured of them holds the cost of making what they need
    bool planned_now_ = false; ///< in the last frame
    bool reset_simulated_ = false;
    int resets_ = 0, last_reset_ = 0; ///< of the GPU, soon after one another; rendered_ at the last
    std::string problems_;            ///< as last told
};

} // namespace bounce
