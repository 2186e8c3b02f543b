#pragma once
// What the window keeps beside the session: its layout, how large pictures are rendered, bookmarks, captures. Most of
// it lives on between runs (ui_state_file.h).

#include "scene/material_model.h"
#include "scene/scene.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace bounce {

/// Where a tab of panels is: the left column, the halves of the right one, the row below the picture.
enum class TabPlace { left, upper, lower, bottom };
inline constexpr std::array<const char*, 4> k_tab_places = {"left", "upper", "lower", "bottom"};
inline constexpr std::array<const char*, 4> k_tab_place_titles = {
    "the column of the scene", "the graph's column, above", "the graph's column, below", "below the picture"};

/// Widths and heights in interface units (pixels at a content scale of 1). Names are those of the columns as they are
/// unless a person swaps them.
struct LayoutState {
    float left = 290, right = 350;
    bool swapped = false;      ///< the left column is on the right
    float right_split = 0.47f; ///< share of the right column's height that its upper half has
    float bottom_height = 260;
    bool show_left = true, show_right = true, show_bottom = false;
};

/// How large the picture is rendered.
struct PictureSizing {
    bool fit = true;     ///< the viewport's size; else `fixed`, or the shot's
    float scale = 1;     ///< share of it: slow machines render fewer pixels
    glm::ivec2 fixed{0}; ///< 0: the shot's own size
};

struct Bookmark {
    std::string shot, name;
    Camera camera;
};

/// What a person may edit of a scene, as it was when the shot was opened.
struct SceneBaseline {
    std::vector<Light> lights;
    std::vector<Node> light_nodes;  ///< the node of each light
    std::vector<Node> object_nodes; ///< that place the objects
    Camera camera;
    Path camera_path;
    std::vector<Material> materials;
    glm::vec3 environment{0};
    bool diffuse_only = false, normal_maps = true;
    MaterialModel material_model = MaterialModel::gltf;
};

class Film;

/// What a recording is written as.
enum class RecordingKind { numbered_png, mp4, webm };

struct CaptureState {
    std::string folder = ".";
    RecordingKind kind = RecordingKind::numbered_png;
    int frames = 60; ///< wanted of a recording; 0: until stopped
    bool recording = false;
    int written = 0;
    std::string pattern;        ///< of numbered frames: "…_%04d.png"; of a film its file
    std::shared_ptr<Film> film; ///< while one is recorded
    std::string last;           ///< what was written last

    std::string saved_shot;  ///< the shot file that was saved last,
    std::string saved_state; ///< and what it holds: another state makes it stale
};

/// What a person has changed and not saved, by file, as JSON (work.h).
struct UnsavedWork {
    std::map<std::string, std::string> shots, graphs;
};

struct WindowState {
    LayoutState layout;
    PictureSizing sizing;
    glm::ivec2 size{1280, 720}; ///< of the window, in screen coordinates
    bool maximized = false;
    float interface_scale = 1;                  ///< a person's factor on top of the display's
    std::map<std::string, TabPlace> tab_places; ///< of those that were moved
    std::string left_tab = "Scene", upper_tab = "Graph", lower_tab = "Parameters", bottom_tab = "Nodes";
    std::string shot, graph; ///< of the last run
    std::vector<Bookmark> bookmarks;
    std::vector<std::string> recent_files; ///< that were opened by their path, the newest first (open_dialog.h)
    float path_seconds = 2;                ///< between two bookmarks of a camera path
    float fly_speed = 1;                   ///< 1: the scene's diagonal in ten seconds
    std::set<std::string> closed_passes;   ///< whose parameters are not shown
    bool coarse_while_moving = true;       ///< where frames are slow, fewer pixels are rendered while something moves
    CaptureState capture;
    UnsavedWork work;

    // Not kept between runs.
    SceneBaseline opened;
    std::string discarding;       ///< edits of the shot that a person is asked about; empty: no question
    std::string select_tab;       ///< tab to bring to the front at the next frame
    float image_zoom = 1;         ///< of the viewport's picture, by Ctrl + wheel
    glm::vec2 image_centre{0.5f}; ///< part of the picture in the viewport's middle
    std::vector<std::function<void()>> later;

    /// Runs between two frames; an Error it throws is shown and ends nothing. For what replaces the scene or graph that
    /// panels are drawing.
    void ask(std::function<void()> action) { later.push_back(std::move(action)); }
};

/// Shows that tab below the picture, or hides the row that it is the front of. One that was moved elsewhere is shown
/// there.
inline void toggle_bottom(WindowState& window, const std::string& tab) {
    if (const auto moved = window.tab_places.find(tab); moved != window.tab_places.end()) {
        (moved->second == TabPlace::left ? window.layout.show_left : window.layout.show_right) = true;
        window.select_tab = tab;
        return;
    }
    window.layout.show_bottom = !window.layout.show_bottom || window.bottom_tab != tab;
    if (window.layout.show_bottom) window.select_tab = tab;
}

} // namespace bounce
