#pragma once
// What both hosts drive: a shot, a graph, a frame index. Needs a current OpenGL context.

#include "graph/graph.h"
#include "scene/shot.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

inline constexpr const char* k_default_shot = "atrium";
inline constexpr const char* k_default_graph = "direct";

struct SessionOptions {
    std::string shot = k_default_shot;
    std::string graph = k_default_graph;
    std::vector<std::pair<std::string, std::string>> sets; ///< "id.parameter" → text, from --set
    std::vector<std::pair<std::string, bool>> switches;    ///< pass → on or off, from --enable and --disable
    std::string resource;                                  ///< the passes that make it are switched on
    std::optional<glm::ivec2> size;                        ///< instead of the shot's
    std::optional<MaterialModel> material_model;           ///< instead of the shot's
    Rebuild rebuild = Rebuild::every_frame;                ///< what graph.rebuild is unless it is set
    bool check_nan = false;
};

/// Values and switches, and the passes that make `resource`. Throws Error with everything that is wrong.
void apply_options(GraphModel& model, const SessionOptions& options);

class Session {
  public:
    /// Loads the shot and the graph, applies the options. Throws Error.
    explicit Session(SessionOptions options);
    ~Session();

    // --- what is shown ---
    void open_shot(const std::string& name);  ///< throws Error; the old shot then stays
    void open_graph(const std::string& name); ///< likewise; values that a person set are kept where they fit
    Shot& shot() { return *shot_; }
    const Shot& shot() const { return *shot_; }
    const SceneFacts& facts() const { return facts_; }
    /// What the shot needs of methods, measured when it is first asked for (reference/scene_needs.h).
    const SceneNeeds& needs();
    Graph& graph() { return *graph_; }
    const Graph& graph() const { return *graph_; }
    const GpuScene& gpu_scene() const { return *gpu_scene_; }
    const SessionOptions& options() const { return options_; }

    /// After an edit of shot().scene.lights, nodes, materials or the environment.
    void scene_edited() {
        scene_dirty_ = true;
        ++edits_;
    }
    /// Once objects, lights or the shot's camera path have come to rest elsewhere: "auto" follows what the shot needs
    /// now. Returns whether it was measured again.
    bool measure_moved_needs();
    /// Grows with every edit and every scene that is opened.
    uint64_t edits() const { return edits_; }

    // --- time ---
    int frame() const { return frame_; }
    void set_frame(int frame); ///< frames back, and jumps, void history
    void advance() { ++frame_; }
    float time() const { return shot_->time_at(frame_); }

    // --- camera ---
    /// The camera of this frame: the shot's, unless one was set.
    Camera camera() const;
    bool camera_is_set() const { return camera_.has_value(); }
    void set_camera(const Camera& camera, bool cut = false);
    void follow_shot_camera();

    // --- size ---
    glm::ivec2 size() const { return size_; }
    void resize(glm::ivec2 size);

    /// Plans and renders the present frame. Throws Error when there never was a good plan, and ContextLost when the GPU
    /// was reset meanwhile: what was rendered is void then. `whole`: waits for what the passes counted, and renders
    /// again with larger buffers as long as one was too small (the window shows a badge instead, and has the room a
    /// frame later).
    /// With `between`, see Graph::execute(). Returns whether the frame was rendered to its end.
    bool render(bool whole = false, const BetweenPasses& between = {});
    /// Whether the last frame was rendered to its end.
    bool is_whole() const { return is_whole_; }
    /// Renders the frame that was left between two passes to its end: for who keeps a picture of it.
    void finish_frame() {
        if (!is_whole_) render();
    }
    /// Polls the watched files of graph and shaders. Returns true when something was reloaded.
    bool poll_files() { return graph_->poll_files(); }
    const SceneState& scene_state() const { return state_.scene; }
    const FrameConstants& constants() const { return constants_; }
    /// What the first three channels of a texture are to be multiplied by to be what they mean: 1 ÷ pre-exposure for
    /// light, 1 for everything else.
    float value_scale(const std::string& resource) const;

    /// "id.parameter" from text; throws Error.
    void set_parameter(const std::string& name, const std::string& text, ParameterOrigin origin);
    /// Every parameter that is not at its default, as name and --set text.
    std::vector<std::pair<std::string, std::string>> changed_parameters(ParameterOrigin at_least) const;

    /// The command that makes this picture without a window (a shot file must hold the camera when one was set).
    std::string command_line(const std::string& output) const;

    /// After a GPU reset: lets go of what is on the GPU. What a person sees and has set stays (shot and its edits,
    /// camera, graph, values, switches, frame), and so does what is known to be wrong.
    void release_gpu();
    /// With a new context current: everything on the GPU is made again; the program that is to blame stays disabled
    /// (Graph::restore_gpu). Throws Error when it cannot be made; it may then be tried again, after release_gpu().
    void restore_gpu();

  private:
    void load_scene_to_gpu();
    /// Parameters that are set to "auto" take their values from the shot's needs.
    void resolve_auto(GraphModel& model);
    /// The graph of that name with the session's settings, for values to be put into. Throws Error.
    std::unique_ptr<Graph> make_graph(const std::string& name) const;

    SessionOptions options_;
    std::unique_ptr<Shot> shot_;
    SceneFacts facts_;
    std::optional<SceneNeeds> needs_;
    uint64_t needs_places_ = 0; ///< digest of the lights and places for which they were measured
    std::unique_ptr<GpuScene> gpu_scene_;
    std::unique_ptr<Graph> graph_;
    TimerMode timer_mode_;
    ShotState state_;
    FrameConstants constants_;
    glm::mat4 last_view_projection_{1};
    bool has_last_view_ = false;
    std::optional<Camera> camera_;
    glm::ivec2 size_{1};
    int frame_ = 0;
    int rendered_frame_ = -1;
    bool is_whole_ = true; ///< the last frame was rendered to its end
    uint64_t camera_cuts_ = 0;
    bool scene_dirty_ = true;
    uint64_t edits_ = 0;

    ResetCause reset_ = ResetCause::none; ///< while the GPU is lost
};

} // namespace bounce
