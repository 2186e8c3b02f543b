#pragma once
// What passes cost: GPU time of each run, and of each frame, in which a pass that did not run costs nothing.

#include "gpu/timer.h"

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace bounce {

/// GPU time of a pass over its last runs, milliseconds.
struct PassTiming {
    double last = 0, median = 0;
    double low = 0, high = 0; ///< 10th and 90th percentile
    int samples = 0;          ///< runs; 0: median, low and high are those of the last run, if there ever was one
    double per_frame = 0;     ///< mean over the last frames, 0 for those in which it did not run
    bool unchanged = false;   ///< it did not run in the newest frame, since its inputs had not changed
};

class Timings {
  public:
    explicit Timings(TimerMode mode) : mode_(mode) {}

    /// Around the pass, or one step of `steps` of it: a run's time is the sum of its steps'.
    void begin(const std::string& id, size_t step, size_t steps);
    void end(const std::string& id, size_t step);
    /// It was left between its steps: what was measured of some of them tells nothing.
    void drop(const std::string& id);
    /// It did not run in this frame.
    void skip(const std::string& id);
    /// Takes what is ready.
    void take();
    /// Starts the statistics afresh (after a warm-up); the cost of the last run stays.
    void forget();
    PassTiming of(const std::string& id) const;

  private:
    struct Part {
        std::unique_ptr<GpuTimer> timer;
        std::deque<double> ready;
    };
    struct Times {
        std::vector<Part> parts;   ///< one a step
        std::deque<bool> pending;  ///< frames whose cost is not known yet, oldest first: whether it ran
        std::deque<double> runs;   ///< milliseconds
        std::deque<double> frames; ///< likewise, 0 where it did not run
        double last = 0;
        bool skipped = false;
    };
    static void take(Times& times);

    TimerMode mode_;
    std::map<std::string, Times> times_;
};

} // namespace bounce
