#pragma once
// A case of the stability suite on the graph that the window shows, with its edited values: a rung between two frames.

#include "app/experiments/stability_suite.h"

namespace bounce {

class StabilityRun {
  public:
    std::string chosen = "sealed_room"; ///< case

    /// Begins the chosen case on the session's graph as it is set now. Throws Error.
    void start(const Session& session);
    void stop() { running_ = false; }
    bool running() const { return running_; }
    /// Measures the next rung, for some seconds. What goes wrong ends the run and is its problem.
    void step();

    /// Null before the first start.
    const StabilityMeasurement* measurement() const { return measurement_.get(); }
    const std::string& graph() const { return graph_; }
    /// The graph or its values are others by now than those that were measured.
    bool stale(const Session& session) const;
    const std::string& problem() const { return problem_; }

  private:
    std::unique_ptr<StabilityMeasurement> measurement_;
    std::string graph_, values_, problem_;
    bool running_ = false;
};

} // namespace bounce
