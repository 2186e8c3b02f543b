#pragma once
// What the last frames cost and how far they were off: memory of the window, for plots over time.

#include "app/session.h"

#include <deque>
#include <map>
#include <string>
#include <vector>

namespace bounce {

class LiveComparison;

/// One rendered frame.
struct TimelineFrame {
    uint64_t number = 0;       ///< of rendered frames
    int shot_frame = 0;        ///< the session's
    float ms = 0;              ///< whole, panels and display included
    std::vector<float> passes; ///< GPU ms by Timeline::passes, as known when the frame ended; 0: it did not run
    uint64_t bytes = 0;        ///< of the graph
    float error = -1;          ///< by the metric of the Compare panel; −1: not measured
    float change = -1; ///< mean |difference| of display values from the frame before, 0 … 1; −1: not measured
    bool settings_changed = false; ///< against the frame before

    float passes_ms() const;
};

struct Timeline {
    static constexpr size_t k_kept = 600; ///< frames

    std::vector<std::string> passes;  ///< names, in the order in which they first came
    std::deque<TimelineFrame> frames; ///< newest last
    uint64_t pinned = 0;              ///< number of the frame whose figures are kept in view; 0: the newest
    bool wants_change = false;        ///< somebody looks: set each frame

    /// After a frame was rendered. `settings`: settings_key().
    void add(const Session& session, float ms, const LiveComparison* comparison, const std::string& settings);
    /// The pinned frame, else the newest; null: there is none.
    const TimelineFrame* shown() const;

  private:
    float change_of(const Session& session);

    uint64_t added_ = 0;
    std::string settings_;
    std::vector<uint8_t> display_; ///< of the frame before, a part of its pixels
};

} // namespace bounce
