#pragma once
// A running graph: its plan, its OpenGL objects, reloads that never cost the running picture.

#include "core/file_watch.h"
#include "gpu/context_loss.h"
#include "gpu/timer.h"
#include "graph/allocations.h"
#include "graph/context.h"
#include "graph/counters.h"
#include "graph/invalidation.h"
#include "graph/nan_check.h"
#include "graph/timings.h"

#include <functional>
#include <memory>
#include <set>

namespace bounce {

struct FrameInputs {
    const GpuScene* scene = nullptr;
    const SceneFacts* facts = nullptr;
    FrameConstants constants; ///< previous_view_projection, lights … filled in by the session
};

/// See Graph::execute(). `done`: share of the frame's passes and steps.
using BetweenPasses = std::function<bool(float done)>;

/// What can go wrong while the program lives on.
struct GraphProblem {
    std::string where; ///< "graph file", "pass direct", …
    ShaderError error;
};

class Graph {
  public:
    /// Throws Error when the file is bad; shaders that do not compile only show in problems().
    Graph(const std::filesystem::path& file, TimerMode timer_mode);
    ~Graph();

    GraphModel& model() { return *model_; }
    const GraphModel& model() const { return *model_; }
    const Plan& plan() const { return plan_; }
    bool planned() const { return planned_; }

    /// Plans, allocates and compiles as far as anything changed: a parameter that only feeds a uniform changes none of
    /// it, a static one its program, one that shapes resources the plan. Throws Error the first time only; later a
    /// failure keeps the last good plan and shows in problems().
    void prepare(const SceneFacts& facts, glm::ivec2 size);
    /// One frame. prepare() must have run. `between` is called between passes and between their steps; it may draw, but
    /// must not change the model. When it returns false the rest of the frame is left out, and what changed since the
    /// last whole frame is made in the next. Returns whether the frame is whole.
    bool execute(const FrameInputs& inputs, const BetweenPasses& between = {});

    /// Waits for what the passes counted in this frame. True when a buffer of one of them was too small: the frame is
    /// to be prepared and executed again, with more (until it fits).
    bool needs_larger_buffers();

    /// Looks at the watched files; reloads what changed, keeping the last good graph. Returns true when something
    /// changed.
    bool poll_files();
    /// Plan again at the next prepare(), even if nothing seems to have changed.
    void touch() { dirty_ = true; }
    /// How often it was planned, for tests and the log.
    uint64_t plans() const { return plans_; }
    /// Camera cut, or a jump in time: persistent and previous contents are void.
    void reset_history() { invalidation_.cut(); }
    /// What "rebuild" is unless a person sets it; stays when the graph file is reloaded.
    void set_default_rebuild(Rebuild rebuild);
    /// Before the context goes, or after it was lost: lets go of all that is in it. The plan, parameters, problems and
    /// the text of the programs that ran stay.
    void release_gpu();
    /// With another context current: makes it again. Of a reset that `cause` tells of, the pass that was running is
    /// disabled where it is known, and else the program that was compiled last because of an edit, unless another
    /// program was to blame. The next frames are watched pass by pass, so that a second reset names its pass. Throws
    /// Error when it does not fit.
    void restore_gpu(ResetCause cause);
    /// The pass in which the context was lost; empty: not lost, or not known.
    const std::string& lost_in() const { return lost_in_; }

    /// Every problem at present: the graph file's, the plan's, each shader's.
    std::vector<GraphProblem> problems() const;
    /// Whether a pass runs with a program older than its text, or not at all.
    bool pass_is_stale(const std::string& id) const;

    /// Waits for measurements that are still on their way (headless runs, before they report).
    void finish_timings();
    /// Starts the statistics afresh (after a warm-up).
    void forget_timings();
    PassTiming timing(const std::string& id) const { return timings_.of(id); }
    /// What the passes counted in the newest frame that has been read back.
    const std::vector<CounterValue>& counters() const { return counters_.newest(); }
    /// Milliseconds a frame. every_frame: the sum of the passes' medians; on_change: the mean over the last frames, in
    /// which passes that did not run cost nothing.
    double frame_ms() const;
    /// The texture behind a resource; null for buffers and unknown names.
    const GpuTexture* texture(const std::string& resource) const;
    const Buffer* buffer(const std::string& resource) const;

    /// Non-finite values are looked for after each pass when set (always in debug builds).
    bool check_nan = false;
    const std::map<std::string, uint64_t>& non_finite() const {
        return non_finite_;
    } ///< resource → count, newest frame
    uint64_t frames() const { return frames_; }

  private:
    friend class PassContext;
    /// The text that was last given to the driver, and what it said.
    struct Built {
        std::string text;
        std::vector<ShaderError> errors;
        bool read = true; ///< false: the errors are of reading the files, and say nothing of the text
    };

    void make_objects();
    void plan_again(const SceneFacts& facts, glm::ivec2 size);
    void build_programs();
    void disable_programs(const std::vector<std::filesystem::path>& files, const std::string& why);
    std::vector<std::string> check_interface(const PassNode& node, const PlanPass& pass,
                                             const ProgramInterface& interface) const;
    bool needs_plan(const SceneFacts& facts, glm::ivec2 size);
    bool run_steps(size_t first, size_t last, const std::function<bool(int)>& goes_on);
    void run_pass(size_t index, int from, int to, bool cut);
    void end_execution();
    void ask_for_larger_buffers();
    void fill_failed(const PlanPass& pass);
    void look_for_nan(const PlanPass& pass);
    /// What the consumers of a skipped pass are given: `value` at every texel.
    GLuint neutral_texture(GLenum sampler_type, glm::vec4 value, glm::ivec2 size);
    void watch();

    std::unique_ptr<GraphModel> model_;
    Plan plan_;
    bool planned_ = false;
    bool dirty_ = true;
    uint64_t plans_ = 0;
    std::vector<bool> planned_switches_; ///< of the nodes
    Rebuild default_rebuild_ = Rebuild::every_frame;
    Invalidation invalidation_;
    bool needs_larger_buffers_ = false; ///< a pass wants larger buffers than this plan gives
    TimerMode timer_mode_;
    Timings timings_;
    Allocations allocations_;
    Counters counters_;
    FileWatch watch_;
    std::map<std::string, Built> built_;              ///< per "id/program"
    std::map<std::string, std::string> broke_;        ///< pass id → why it could not run in the newest frame
    std::vector<std::filesystem::path> edited_files_; ///< of the program that was edited last
    std::set<std::string> failed_;                    ///< passes of which a step could not run in this frame
    std::string lost_in_;
    int watched_frames_ = 0; ///< in which each pass is waited for, and asked whether the context was lost in it
    std::string file_problem_, plan_problem_;
    std::vector<std::filesystem::path> broken_chain_; ///< the files of a graph that could not be reloaded
    SceneFacts planned_facts_;
    Buffer empty_buffer_; ///< for storage blocks that nothing fills
    Sampler comparison_sampler_;
    VertexArray empty_vertex_array_;
    std::map<std::tuple<GLenum, std::array<float, 4>, std::array<int, 2>>, GpuTexture> neutrals_;
    std::unique_ptr<NanCheck> nan_check_;
    std::map<std::string, uint64_t> non_finite_;
    bool checked_nan_ = false; ///< in the last frame
    uint64_t frames_ = 0;
    const FrameInputs* inputs_ = nullptr; ///< while executing
};

} // namespace bounce
