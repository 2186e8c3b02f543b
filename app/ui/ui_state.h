#pragma once
// State of the window that is no part of the session.

#include "app/ui/window_state.h"
#include "core/parameters.h"

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

/// How the resource viewer shows a texture.
struct ViewerSettings {
    std::string resource; ///< "" = out.display
    int mip = 0;
    int layer = 0;           ///< layer of an array, slice of a 3D texture
    int channel = 0;         ///< 0 = RGB, 1 … 4 = one of R G B A, 5 = length of RGB
    float low = 0, high = 1; ///< mapped to black and white
    bool automatic_range = false;
    bool encode_srgb = true;     ///< linear values are encoded for the display
    bool mark_non_finite = true; ///< NaN magenta, infinities yellow
    bool logarithmic = false;    ///< equal ratios between low and high are equal steps
    bool false_colour = false;   ///< a single value is a colour of a map, from dark blue over green to yellow
    float over_picture = 1;      ///< share of it, over the final picture where both have the same size
    bool operator==(const ViewerSettings&) const = default;
};

/// What the resources panel shows of a buffer.
struct BufferSettings {
    std::string resource; ///< "" = none
    int page = 0;
    int words = 0; ///< 0 = float, 1 = uint, 2 = int, 3 = hexadecimal
};

/// A parameter under the mouse: from press to release is one step of undo.
struct ParameterEdit {
    std::string name;                                        ///< "direct.normal_offset"; "" = none
    std::string before;                                      ///< its text when the edit began
    ParameterOrigin origin = ParameterOrigin::default_value; ///< who had set it then
    ParameterValue value;                                    ///< as the widget has it
    bool waits = false; ///< it is applied at the end: it is typed, or shapes the plan
};

/// Time of a whole frame, panels and display included.
struct FrameTime {
    float ms = 0;
    bool current = true; ///< of the settings that are shown; else of earlier ones
};

class LiveComparison;
struct ConesState;
struct NodesState;
class ParameterSweep;
struct PinnedRayList;
struct Snapshots;
struct Timeline;
class StabilityRun;

struct UiState {
    // What the viewport shows: a hovered pass's output wins over a pinned one, that over the viewer's choice.
    std::string hovered; ///< resource; set each frame by the graph panel, else empty
    std::string pinned;  ///< resource; empty = out.display
    ViewerSettings viewer;
    BufferSettings buffer;

    ParameterEdit edit;
    std::string parameter_filter;         ///< of the parameters panel
    bool only_changed_parameters = false; ///< likewise

    bool paused = true;         ///< time stands still (a still shot needs no clock)
    bool single_step = false;   ///< advance one frame, then pause
    bool render_always = false; ///< render every frame even when nothing changed
    int redraw_frames = 2;      ///< frames that are still to be rendered because something changed

    glm::ivec2 cursor_pixel{-1}; ///< of the picture, row 0 at the top; −1 outside
    glm::vec2 cursor_uv{-1};     ///< the same place as a share of width and height, for resources of other sizes
    bool cursor_locked = false;  ///< the inspector keeps its pixel
    int chosen_light = -1;       ///< that is dragged in the picture; −1: none
    int chosen_object = -1;      ///< likewise a placed object; at most one of the two is chosen

    std::vector<FrameTime> frame_times; ///< of the last frames, newest last
    std::string notice;                 ///< one line for the status bar
    bool notice_is_error = false;

    /// What the camera has done since it rested becomes a step of undo now; empty where there is no window.
    std::function<void()> note_camera;
    /// Makes the context and all that is on the GPU again, between two frames; empty where there is no window.
    std::function<void()> make_gpu_again;

    std::shared_ptr<LiveComparison> comparison; ///< made when its panel is first opened
    std::shared_ptr<ConesState> cones;          ///< likewise
    std::shared_ptr<NodesState> nodes;          ///< likewise
    std::shared_ptr<Snapshots> snapshots;       ///< likewise
    std::shared_ptr<PinnedRayList> pinned_rays; ///< made when the first are pinned
    std::shared_ptr<Timeline> timeline;         ///< made with the first frame
    std::shared_ptr<ParameterSweep> sweep;      ///< made when the first is asked for
    std::shared_ptr<StabilityRun> stability;    ///< likewise
    bool redraw_panels = false; ///< set each frame by panels that move by themselves (progress, flicker)

    bool mid_frame = false; ///< the panels are drawn between two passes of a frame: the graph must not change
    float frame_share = 0;  ///< of its passes that are done
    std::vector<std::function<void()>> after_frame;    ///< what waits for its end,
    std::map<std::string, std::string> waiting_values; ///< and the parameters that are then set

    bool show_keys = false;
    WindowState window;

    /// Something changed: render again.
    void redraw() { redraw_frames = 2; }
    /// Now, or when the frame that is being rendered has ended: for what changes the graph.
    void change_graph(std::function<void()> action) {
        if (!mid_frame) return action();
        after_frame.push_back(std::move(action));
    }
    void say(const std::string& text, bool error = false) { notice = text, notice_is_error = error; }
};

} // namespace bounce
