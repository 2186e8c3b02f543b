#pragma once
// Which passes have to run, and what is void of what earlier frames left. Every pass has an input revision, made from
// all that reaches it: its programs' text, its parameters, the parts of scene and frame that they really use, what it
// looked at on the CPU, and the revisions of what it reads. No pass keeps a list of what it depends on.

#include "core/revision.h"
#include "graph/allocations.h"
#include "graph/model.h"
#include "graph/pass_inputs.h"

#include <map>
#include <string>
#include <vector>

namespace bounce {

struct FrameInputs;

class Invalidation {
  public:
    /// Another plan, or other programs: what is known of passes and resources that it does not have is forgotten.
    void new_plan(const GraphModel& model, const Plan& plan);
    /// A camera cut, or a jump in time: what frames left for those after them is void.
    void cut() { ++cuts_; }

    /// Compares this frame's inputs with those of earlier frames. Afterwards runs(), voids() and stands() tell.
    /// `every_frame`: all passes run.
    void begin_frame(const GraphModel& model, const Plan& plan, const Allocations& allocations,
                     const FrameInputs& frame, bool every_frame);
    /// Whether the pass, an index into Plan::passes, runs in this frame.
    bool runs(size_t pass) const { return runs_[pass]; }
    /// Resources that lose what they keep from earlier frames.
    const std::vector<int>& voids() const { return voids_; }
    bool stands(int resource) const { return stands_[size_t(resource)]; }
    /// Where the pass's looks on the CPU are recorded.
    PassInputs& inputs(const std::string& id) { return passes_[id].inputs; }
    /// The pass has run. `whole`: without an error; else what it keeps is void in the next frame.
    void ran(size_t pass, const GraphModel& model, const Plan& plan, const Allocations& allocations,
             const FrameInputs& frame, bool whole);
    /// The frame ends within or after the passes `first` to `last`: in the next one they run again, and so do all
    /// writers of what only some of them have written. What was begun anew in this frame is void.
    void cut_short(const Plan& plan, size_t first, size_t last);
    /// Resources whose last frame's copy is not that of this frame yet; from here on it counts as made.
    std::vector<int> end_frame(const Plan& plan);

  private:
    struct PassState {
        PassInputs inputs;
        Revision seen;    ///< digests of its own inputs when they were last looked at
        Revision own;     ///< numbers that grow when one of those changes
        uint64_t ran = 0; ///< the whole revision with which it ran last; 0: never
    };
    struct Kept {
        uint64_t key = 0;     ///< what its makers were; 0: nothing is known
        uint64_t content = 0; ///< revision at the end of the last frame; 0: void
        uint64_t copied = 0;  ///< of last frame's copy
    };
    void find_reach(const Plan& plan);
    void find_voids(const Plan& plan);
    void find_revisions(const Plan& plan);
    void find_runs(const Plan& plan, bool every_frame);
    uint64_t reaching(const Plan& plan, size_t pass, Cause cause) const;

    // Of the plan and its programs:
    std::vector<std::vector<bool>> active_; ///< [pass][slot]: it is really used
    std::vector<bool> follows_;             ///< passes that know where the camera was
    std::vector<std::vector<bool>> reach_;  ///< [pass][other]: what the other makes reaches the pass

    std::map<std::string, PassState> passes_; ///< by id
    std::map<std::string, Kept> kept_;        ///< by resource: persistent, incremental, or with last frame's copy
    std::vector<uint64_t> revisions_;         ///< of passes in this frame
    std::vector<uint64_t> contents_;          ///< of resources at the end of this frame
    std::map<std::string, uint64_t> lies_;    ///< by resource: what was there at the end of the last frame
    std::vector<bool> runs_, stands_;
    std::vector<int> voids_;
    uint64_t serial_ = 0, cuts_ = 0;
};

} // namespace bounce
