#pragma once
// Runs stability cases on graphs: a cell for each case and graph, with the curve over the case's ladder.

#include "app/experiments/stability_case.h"
#include "app/experiments/variant.h"

#include <functional>
#include <memory>
#include <optional>

namespace bounce {

struct StabilityCell {
    std::string graph;
    std::vector<double> curve;    ///< one value a rung; fewer where a rung could not be measured
    std::string failure;          ///< why the case could not be measured with this graph; "" otherwise
    std::optional<double> figure; ///< what is held to the mark; none with a failure
    double seconds = 0;           ///< that it took
    bool reached = false;         ///< |figure| ≤ the case's mark
    std::string key{};            ///< digest of all that made it: program, case, graph, settings
};

struct StabilityRow {
    StabilityCase which;
    std::vector<StabilityCell> cells;
};

/// One case with one graph, rung by rung. Its session is its own: what else is shown stays as it is.
class StabilityMeasurement {
  public:
    /// `own`: what is set of the graph besides what the case sets. Throws Error.
    StabilityMeasurement(const StabilityCase& which, const std::string& graph, const Variant& own = {});
    ~StabilityMeasurement();

    bool done() const { return curve_.size() == which_.ladder.size(); }
    /// Measures the next rung. Throws Error.
    void step();
    const StabilityCase& which() const { return which_; }
    const std::vector<double>& curve() const { return curve_; }

  private:
    class Rungs;
    StabilityCase which_;
    std::unique_ptr<Rungs> rungs_;
    std::vector<double> curve_;
};

/// What of a curve is held to the mark. The curve has at least one value.
double summary_of(StabilitySummary summary, const std::vector<double>& curve);

/// Measures one case with one graph; what cannot be measured is the cell's failure. Needs a current OpenGL context.
StabilityCell measure_stability(const StabilityCase& which, const std::string& graph, const Variant& own = {});

struct StabilitySuite {
    std::vector<StabilityCase> cases;
    std::vector<std::string> graphs;
    Variant own; ///< what is set of every graph besides
    /// Cells that were measured before: one with the same case, graph and key is taken over.
    std::vector<StabilityRow> known;
};

/// All cases with all graphs, case by case. `done` gets the rows so far after each cell, and whether that cell was
/// known.
std::vector<StabilityRow> run_stability(const StabilitySuite& suite,
                                        const std::function<void(const std::vector<StabilityRow>&, bool)>& done);

} // namespace bounce
