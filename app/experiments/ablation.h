#pragma once
// What each part of a graph buys on a shot: every pass that can be switched off and every departure from the graph that
// it starts from, put back one at a time and the strongest in pairs; and the smallest graph that is still worth it.

#include "app/experiments/variant.h"

#include <functional>
#include <string>
#include <vector>

namespace bounce {

struct AblationSettings {
    SessionOptions session; ///< the shot, the graph, what else holds
    std::string published;  ///< departures are put back to this graph's values; "": that which the graph extends
    int samples = 256, frames = 3;
    int pairs_of = 4; ///< so many of the strongest are also left out two by two
    double worth = 1; ///< per cent of the error that a part must take away for each per cent of the time that it takes
};

/// One thing left out.
struct AblatedPart {
    std::string name;   ///< "gather.exact_hits: true → false", "filter off"
    Variant without;    ///< the graph without it
    std::string failed; ///< why the graph does not work without it; "" otherwise
    VariantFigures figures;
    /// Of the graph without it against the whole one.
    double time_change = 0;    ///< share of the whole's time: −0.3 = 30 % less without it
    double bytes_change = 0;   ///< likewise
    double error_change = 0;   ///< points of relative RMSE: 0.1 = 10 points more without it
    double flicker_change = 0; ///< points of flicker, likewise
    double uncertainty = 0;    ///< of error_change: one standard deviation over the frames of both
};

struct Ablation {
    VariantFigures whole;
    std::vector<AblatedPart> parts; ///< what buys most first
    std::vector<AblatedPart> pairs;
    Variant minimal; ///< without all that is not worth its time
    VariantFigures minimal_figures;
    std::vector<std::string> dropped; ///< in the order in which they went
};

/// What can be left out of the graph, unmeasured. Throws Error.
std::vector<AblatedPart> parts_to_leave_out(const GraphModel& graph, const GraphModel* published, const Plan& plan);
/// The graph that this one extends, unless that is one of assets/graphs/base: its name, or "".
std::string published_graph_of(const std::string& graph);

/// Measures all of it; `say` gets a line for each. At the end the measurer's session has the minimal graph.
Ablation ablate(VariantMeasurer& measurer, const AblationSettings& settings,
                const std::function<void(const std::string&)>& say);

} // namespace bounce
