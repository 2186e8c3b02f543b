#include "app/experiments/tune_search.h"

#include "core/error.h"
#include "core/parameter_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bounce {

namespace {

constexpr double k_limit_weight = 20; ///< e-folds of time for an e-fold above a limit
constexpr double k_gain = 0.005;      ///< of the objective, that is no noise
constexpr size_t k_max_pairs = 24;    ///< that are tried after a round without success

double above(double value, const std::optional<double>& limit) {
    return limit && value > *limit ? std::log(value / *limit) : 0;
}

struct Move {
    std::string name, text;
    double gain = 0; ///< that it brought from where it was tried last
};

class Search {
  public:
    Search(const std::vector<TuneParameter>& parameters, TuneGoal goal, int budget, const TuneEvaluator& evaluate,
           const std::function<bool()>& go_on)
        : parameters_(parameters), goal_(goal), budget_(budget), evaluate_(evaluate), go_on_(go_on) {}

    TuneResult run() {
        const std::optional<TuneFigures> start = figures_of({});
        if (!start) throw Error("the graph does not work as it is");
        result_.start = result_.best = {{}, *start};
        if (!goal_.error && !goal_.ms) goal_.error = start->error;
        best_value_ = tune_objective(goal_, *start);
        std::vector<Move> moves = screened();
        try_together(moves);
        while (round(moves) || pair_helps()) {
        }
        return result_;
    }

  private:
    bool spent() const { return int(known_.size()) >= budget_ || !go_on_(); }

    std::optional<TuneFigures> figures_of(const Variant& variant) {
        const auto known = known_.find(variant);
        if (known != known_.end()) return known->second;
        const std::optional<TuneFigures> figures = evaluate_(variant);
        known_[variant] = figures;
        if (figures) result_.points.push_back({variant, *figures});
        return figures;
    }

    /// How much better than the best; the best becomes this when it is.
    double try_variant(const Variant& variant) {
        const std::optional<TuneFigures> figures = figures_of(variant);
        if (!figures) return -std::numeric_limits<double>::infinity();
        const double value = tune_objective(goal_, *figures), gain = best_value_ - value;
        if (gain > k_gain) {
            best_value_ = value;
            result_.best = {variant, *figures};
        }
        return gain;
    }

    Variant with(Variant variant, const Move& move) const {
        const auto own = std::find_if(parameters_.begin(), parameters_.end(),
                                      [&](const TuneParameter& p) { return p.name == move.name; });
        if (own->own == move.text)
            variant.sets.erase(move.name);
        else
            variant.sets[move.name] = move.text;
        return variant;
    }

    std::vector<Move> moves_from(const Variant& variant) const {
        std::vector<Move> moves;
        for (const TuneParameter& parameter : parameters_) {
            const auto set = variant.sets.find(parameter.name);
            for (const std::string& text :
                 neighbours_of(parameter, set == variant.sets.end() ? parameter.own : set->second))
                moves.push_back({parameter.name, text, 0});
        }
        return moves;
    }

    /// Every move from the start, without taking any; the best first.
    std::vector<Move> screened() {
        std::vector<Move> moves;
        for (Move move : moves_from({})) {
            if (spent()) break;
            const std::optional<TuneFigures> figures = figures_of(with({}, move));
            if (!figures) continue;
            move.gain = best_value_ - tune_objective(goal_, *figures);
            moves.push_back(move);
        }
        std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.gain > b.gain; });
        return moves;
    }

    /// All that help, of each parameter the best; then the better half of them, and so on.
    void try_together(const std::vector<Move>& moves) {
        std::vector<Move> helping;
        for (const Move& move : moves)
            if (move.gain > k_gain && std::none_of(helping.begin(), helping.end(),
                                                   [&](const Move& known) { return known.name == move.name; }))
                helping.push_back(move);
        while (!helping.empty() && !spent()) {
            Variant together;
            for (const Move& move : helping)
                together = with(together, move);
            try_variant(together);
            helping.resize(helping.size() / 2);
        }
    }

    /// One move after the other from the best so far, those first that helped most when they were tried last. Whether
    /// any helped.
    bool round(std::vector<Move>& tried) {
        std::map<std::string, double> gains; // of each parameter
        for (const Move& move : tried) {
            const auto [it, is_new] = gains.emplace(move.name, move.gain);
            it->second = std::max(it->second, move.gain);
        }
        std::vector<Move> moves = moves_from(result_.best.variant);
        for (Move& move : moves)
            if (const auto known = gains.find(move.name); known != gains.end()) move.gain = known->second;
        std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.gain > b.gain; });
        tried.clear();
        bool helped = false;
        for (Move& move : moves) {
            if (spent()) return false;
            const double before = best_value_;
            move.gain = try_variant(with(result_.best.variant, move));
            tried.push_back(move);
            helped |= best_value_ < before;
        }
        return helped;
    }

    /// After a round that brought nothing: two moves at once, where what each does by itself lets expect that they help
    /// (a filter that costs more and errs less, with fewer rays). Whether one did.
    bool pair_helps() {
        struct Single {
            Move move;
            TuneFigures figures;
        };
        struct Pair {
            Variant variant;
            double expected;
        };
        const TunePoint from = result_.best;
        std::vector<Single> singles;
        for (const Move& move : moves_from(from.variant)) {
            const auto known = known_.find(with(from.variant, move));
            if (known != known_.end() && known->second) singles.push_back({move, *known->second});
        }
        std::vector<Pair> pairs;
        for (size_t i = 0; i < singles.size(); ++i)
            for (size_t k = i + 1; k < singles.size(); ++k) {
                const TuneFigures &a = singles[i].figures, &b = singles[k].figures, &own = from.figures;
                if (singles[i].move.name == singles[k].move.name) continue;
                // Factors of time, error and memory multiply.
                const TuneFigures expected{a.ms * b.ms / own.ms, a.error * b.error / own.error,
                                           a.bytes * b.bytes / own.bytes};
                const double value = tune_objective(goal_, expected);
                if (value < best_value_ - k_gain)
                    pairs.push_back({with(with(from.variant, singles[i].move), singles[k].move), value});
            }
        std::stable_sort(pairs.begin(), pairs.end(),
                         [](const Pair& a, const Pair& b) { return a.expected < b.expected; });
        for (size_t i = 0; i < std::min(pairs.size(), k_max_pairs) && !spent(); ++i)
            if (try_variant(pairs[i].variant) > k_gain) return true;
        return false;
    }

    const std::vector<TuneParameter>& parameters_;
    TuneGoal goal_;
    int budget_;
    const TuneEvaluator& evaluate_;
    const std::function<bool()>& go_on_;
    std::map<Variant, std::optional<TuneFigures>> known_;
    TuneResult result_;
    double best_value_ = 0;
};

} // namespace

double tune_objective(const TuneGoal& goal, const TuneFigures& figures) {
    const double tiny = 1e-9;
    const double wanted = goal.ms && !goal.error ? figures.error : figures.ms;
    return std::log(std::max(wanted, tiny)) +
           k_limit_weight *
               (above(figures.error, goal.error) + above(figures.ms, goal.ms) + above(figures.bytes, goal.bytes));
}

std::vector<std::string> neighbours_of(const TuneParameter& parameter, const std::string& value) {
    const ParameterInfo& info = parameter.info;
    std::vector<std::string> out;
    const auto add = [&](const ParameterValue& next) {
        const std::string text = to_text(info, next);
        if (text != value && std::find(out.begin(), out.end(), text) == out.end()) out.push_back(text);
    };
    const ParameterValue now = parse_value(info, value);
    for (const ParameterValue& step : steps_beside(info, now))
        add(step);
    if (!out.empty()) return out;
    switch (info.kind) {
    case ParameterKind::boolean:
        add(!std::get<bool>(now));
        break;
    case ParameterKind::enumeration:
        for (size_t i = 0; i < info.choices.size(); ++i)
            add(int(i));
        break;
    case ParameterKind::integer: {
        const double n = std::get<int>(now);
        for (double next : {n / 2, n == 0 ? 1 : 2 * n}) {
            next = std::trunc(next);
            if (next >= info.min && next <= info.max && std::abs(next) <= 1 << 24) add(int(next));
        }
        break;
    }
    case ParameterKind::real: {
        const double x = std::get<float>(now);
        // From nothing, an eighth of the range or of one is a beginning.
        const double first = std::isfinite(info.max) ? info.max / 8 : 0.125;
        for (double next : {x / 2, x == 0 ? first : 2 * x})
            if (next >= info.min && next <= info.max) add(float(next));
        break;
    }
    default: // directions and colours are no settings of quality
        break;
    }
    return out;
}

TuneResult tune_search(const std::vector<TuneParameter>& parameters, const TuneGoal& goal, int budget,
                       const TuneEvaluator& evaluate, const std::function<bool()>& go_on) {
    return Search(parameters, goal, budget, evaluate, go_on).run();
}

std::vector<TunePoint> tune_front(std::vector<TunePoint> points) {
    std::stable_sort(points.begin(), points.end(), [](const TunePoint& a, const TunePoint& b) {
        return a.figures.ms != b.figures.ms ? a.figures.ms < b.figures.ms : a.figures.error < b.figures.error;
    });
    std::vector<TunePoint> front;
    for (TunePoint& point : points)
        if (front.empty() || point.figures.error < front.back().figures.error) front.push_back(std::move(point));
    return front;
}

} // namespace bounce
