#pragma once
// Runs stability cases on graphs: a cell for each case and graph, with the curve over the case's ladder.

#include "app/experiments/stability_case.h"

#include <functional>
#include <optional>

namespace bounce {

struct StabilityCell {
    std::string graph;
    std::vector<double> curve;    ///< one value a rung; fewer where a rung could not be measured
    std::string failure;          ///< why the case could not be measured with this graph; "" otherwise
    std::optional<double> figure; ///< what is held to the mark; none with a failure
    double seconds = 0;           ///< that it took
    bool reached = false;         ///< |figure| ≤ the case's mark
};

struct StabilityRow {
    StabilityCase which;
    std::vector<StabilityCell> cells;
};

/// What of a curve is held to the mark. The curve has at least one value.
double summary_of(StabilitySummary summary, const std::vector<double>& curve);

/// Measures one case with one graph; what cannot be measured is the cell's failure. Needs a current OpenGL context.
StabilityCell measure_stability(const StabilityCase& which, const std::string& graph);

/// All cases with all graphs, case by case. `done` gets the rows so far after each cell.
std::vector<StabilityRow> run_stability(const std::vector<StabilityCase>& cases, const std::vector<std::string>& graphs,
                                        const std::function<void(const std::vector<StabilityRow>&)>& done);

} // namespace bounce
