#include "app/experiments/tune_search.h"

#include "core/error.h"
#include "core/low_discrepancy.h"
#include "core/parameter_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace bounce {

namespace {

/// Gains of moves that nobody has tried.
constexpr double k_untried_choice = 2e9, k_untried_number = 1e9;
constexpr double k_limit_weight = 20; ///< e-folds of time for an e-fold above a limit
constexpr double k_gain = 0.005;      ///< of the objective, that is no noise
constexpr double k_time_noise = 0.02; ///< of itself: beyond a limit of time, what is less is no gain
constexpr double k_far = 2;           ///< times the limit: from there on all sizes shrink at once
constexpr size_t k_max_pairs = 24;    ///< that are tried after a round without success
constexpr int k_max_leaps = 40;       ///< that are tried in vain before the search ends

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
        shrink();
        std::vector<Move> moves;
        while (round(moves) || pair_helps() || leap_helps(moves)) {
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
        if (gain > noise(*figures)) {
            best_value_ = value;
            result_.best = {variant, *figures};
        }
        return gain;
    }

    /// Whether the variant becomes the best. A gain that may be noise is none: a search that went on for it would not
    /// end.
    bool is_taken(const Variant& variant) {
        const double before = best_value_;
        try_variant(variant);
        return best_value_ < before;
    }

    /// How much of a gain may be that of a second measurement of the same.
    double noise(const TuneFigures& figures) const {
        const bool is_late = above(std::max(figures.ms, result_.best.figures.ms), goal_.ms) > 0;
        return k_gain + (is_late ? k_limit_weight * k_time_noise : 0);
    }

    const TuneParameter& parameter(const std::string& name) const {
        return *std::find_if(parameters_.begin(), parameters_.end(),
                             [&](const TuneParameter& p) { return p.name == name; });
    }

    bool is_choice(const std::string& name) const {
        const ParameterKind kind = parameter(name).info.kind;
        return kind == ParameterKind::boolean || kind == ParameterKind::enumeration;
    }

    /// The value of a parameter in a variant.
    std::string text_in(const Variant& variant, const std::string& name) const {
        const auto set = variant.sets.find(name);
        return set == variant.sets.end() ? parameter(name).own : set->second;
    }

    Variant with(Variant variant, const Move& move) const {
        if (parameter(move.name).own == move.text)
            variant.sets.erase(move.name);
        else
            variant.sets[move.name] = move.text;
        return variant;
    }

    std::vector<Move> moves_from(const Variant& variant) const {
        std::vector<Move> moves;
        for (const TuneParameter& parameter : parameters_)
            for (const std::string& text : neighbours_of(parameter, text_in(variant, parameter.name)))
                moves.push_back({parameter.name, text, 0});
        return moves;
    }

    /// Far beyond the time that is allowed, single moves are slow to measure and bring little: all whole numbers, which
    /// are sizes and counts, are halved at once until the time is met or nothing can be halved.
    void shrink() {
        Variant variant;
        while (goal_.ms && result_.best.figures.ms > k_far * *goal_.ms && !spent()) {
            const Variant before = variant;
            for (const TuneParameter& parameter : parameters_) {
                if (parameter.info.kind != ParameterKind::integer) continue;
                const std::string now = text_in(variant, parameter.name);
                const std::vector<std::string> next = neighbours_of(parameter, now);
                if (!next.empty() && less(next.front(), now)) variant.sets[parameter.name] = next.front();
            }
            if (variant == before || try_variant(variant) <= 0) return;
        }
    }

    static bool less(const std::string& a, const std::string& b) { return std::atof(a.c_str()) < std::atof(b.c_str()); }

    /// One move after the other from the best so far, each taken as soon as it helps: what helps only beside another is
    /// found sooner so than by measuring all from the start. First those of parameters that helped most when they were
    /// tried last; in the first round choices, then numbers. Whether any helped.
    bool round(std::vector<Move>& tried) {
        std::map<std::string, double> gains; // of each parameter
        for (const Move& move : tried) {
            const auto [it, is_new] = gains.emplace(move.name, move.gain);
            it->second = std::max(it->second, move.gain);
        }
        std::vector<Move> moves = moves_from(result_.best.variant);
        for (Move& move : moves) {
            const auto known = gains.find(move.name);
            move.gain = known != gains.end()   ? known->second
                        : is_choice(move.name) ? k_untried_choice
                                               : k_untried_number;
        }
        std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.gain > b.gain; });
        tried.clear();
        bool helped = false;
        std::set<std::string> idle; // numbers of parts that are switched off where the search stands
        for (Move& move : moves) {
            if (spent()) return false;
            if (idle.contains(move.name)) continue;
            const TunePoint from = result_.best;
            const bool move_helped = go_further(move);
            tried.push_back(move);
            helped |= move_helped;
            const std::optional<TuneFigures>& figures = known_[with(from.variant, move)];
            if (move_helped)
                idle.clear();
            else if (figures && figures->error == from.figures.error && !is_choice(move.name))
                idle.insert(move.name);
        }
        return helped;
    }

    /// The move, and while it helps the next step in its direction. Notes what the first step brought.
    bool go_further(Move& first) {
        Move move = first;
        std::set<std::string> been;
        for (bool is_first = true;; is_first = false) {
            const double before = best_value_;
            been.insert(text_in(result_.best.variant, move.name));
            move.gain = try_variant(with(result_.best.variant, move));
            if (is_first) first.gain = move.gain;
            if (best_value_ == before) return !is_first;
            if (is_choice(move.name)) return true;
            const std::vector<std::string> next = neighbours_of(parameter(move.name), move.text);
            const auto on = std::find_if(next.begin(), next.end(), [&](auto& text) { return !been.contains(text); });
            if (on == next.end() || spent()) return true;
            move.text = *on;
        }
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
            if (is_taken(pairs[i].variant)) return true;
        return false;
    }

    /// Where single moves and pairs bring nothing: two to four moves at once, of numbers one or two steps, mostly those
    /// that cost least by themselves. Whether one such leap helped.
    bool leap_helps(std::vector<Move> tried) {
        std::stable_sort(tried.begin(), tried.end(), [](const Move& a, const Move& b) { return a.gain > b.gain; });
        std::erase_if(tried, [](const Move& move) { return !std::isfinite(move.gain); });
        for (int leap = 0; leap < k_max_leaps && !tried.empty() && !spent(); ++leap) {
            Variant variant = result_.best.variant;
            std::set<std::string> names;
            for (int tries = 0, wanted = 2 + leap % 3; tries < 32 && int(names.size()) < wanted; ++tries) {
                // The square of a number between 0 and 1: a quarter of the moves is drawn half of the time.
                const double drawn = random();
                const Move& move = tried[std::min(size_t(drawn * drawn * double(tried.size())), tried.size() - 1)];
                if (!names.insert(move.name).second) continue;
                const std::string before = text_in(variant, move.name);
                variant = with(variant, move);
                if (!is_choice(move.name) && random() < 0.5)
                    for (const std::string& text : neighbours_of(parameter(move.name), move.text))
                        if (text != before) variant = with(variant, {move.name, text});
            }
            if (!known_.contains(variant) && is_taken(variant)) return true;
        }
        return false;
    }

    double random() { return unit_float(hash_u32(drawn_++)); }

    const std::vector<TuneParameter>& parameters_;
    TuneGoal goal_;
    int budget_;
    const TuneEvaluator& evaluate_;
    const std::function<bool()>& go_on_;
    std::map<Variant, std::optional<TuneFigures>> known_;
    TuneResult result_;
    double best_value_ = 0;
    uint32_t drawn_ = 0; ///< random numbers
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
