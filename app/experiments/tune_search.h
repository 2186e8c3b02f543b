#pragma once
// The search of `bounce tune`: from a graph's own settings, by moves of one parameter at a time, to settings that reach
// an error at the least time, or the least error within a time. It knows nothing of graphs: figures come from whoever
// evaluates.
//
// A start that is far beyond the time allowed has all its sizes halved first. Then moves are tried one after the other,
// and each that helps is taken at once, and further in its direction, round by round; those first that helped most in
// the round before. After a round that brings nothing, pairs of moves are tried whose separate effects let expect that
// they help together; after these, two to four moves at once, further steps among them, drawn at random with a fixed
// seed. It ends when nothing of this helps, or the budget is spent.

#include "app/experiments/variant.h"
#include "core/parameters.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

struct TuneFigures {
    double ms = 0;    ///< a frame: geometric mean over the shots
    double error = 0; ///< relative RMSE: likewise
    double bytes = 0; ///< the largest
    bool operator==(const TuneFigures&) const = default;
};

/// What is asked for. Without error and time: the error of the start, at the least time.
struct TuneGoal {
    std::optional<double> error, ms, bytes; ///< upper limits
};

struct TuneParameter {
    std::string name; ///< "gather.interleave"
    ParameterInfo info;
    std::string own; ///< its value in the graph, as text
};

struct TunePoint {
    Variant variant;
    TuneFigures figures;
};

/// Nothing where the graph does not work so.
using TuneEvaluator = std::function<std::optional<TuneFigures>(const Variant&)>;

/// Smaller is better; a limit that is exceeded outweighs everything else.
double tune_objective(const TuneGoal& goal, const TuneFigures& figures);
/// The neighbours of a value: half and double of a number, every other choice.
std::vector<std::string> neighbours_of(const TuneParameter& parameter, const std::string& value);

struct TuneResult {
    TunePoint start, best;
    std::vector<TunePoint> points; ///< all that were evaluated and worked, the start first
};

/// Evaluates at most `budget` variants, and asks `go_on` before each. Throws Error when the start itself does not work.
TuneResult tune_search(const std::vector<TuneParameter>& parameters, const TuneGoal& goal, int budget,
                       const TuneEvaluator& evaluate, const std::function<bool()>& go_on);

/// The points that no other beats in both time and error, fastest first.
std::vector<TunePoint> tune_front(std::vector<TunePoint> points);

} // namespace bounce
