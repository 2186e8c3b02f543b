#include "app/experiments/method_front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace bounce {

static const std::string& graph_of(const MethodScore& score) {
    return score.point->task.session.graph;
}

static bool more_accurate(const MethodScore& a, const MethodScore& b) {
    return std::tie(a.error, a.ms) < std::tie(b.error, b.ms);
}

std::vector<MethodScore> scores_of(const std::vector<const ChartPoint*>& points, const ScoreOf& error_of) {
    std::vector<MethodScore> scores;
    for (const ChartPoint* point : points) {
        const std::optional<double> error = error_of(*point);
        if (error && std::isfinite(*error)) scores.push_back({point, point->total_ms, *error});
    }
    return scores;
}

std::vector<MethodScore> front_of(std::vector<MethodScore> scores) {
    std::sort(scores.begin(), scores.end(), [](auto& a, auto& b) {
        return std::tie(a.ms, a.error, graph_of(a), a.point->key) < std::tie(b.ms, b.error, graph_of(b), b.point->key);
    });
    std::vector<MethodScore> front;
    for (const MethodScore& score : scores)
        if (front.empty() || score.error < front.back().error) front.push_back(score);
    return front;
}

std::map<std::string, MethodScore> best_of_graphs(const std::vector<MethodScore>& scores) {
    return best_within(scores, std::numeric_limits<double>::infinity());
}

std::map<std::string, MethodScore> best_within(const std::vector<MethodScore>& scores, double ms) {
    std::map<std::string, MethodScore> best;
    for (const MethodScore& score : scores) {
        if (score.ms > ms) continue;
        const auto [found, added] = best.emplace(graph_of(score), score);
        if (!added && more_accurate(score, found->second)) found->second = score;
    }
    return best;
}

std::vector<BeatenMethod> beaten_everywhere(const std::vector<MethodScore>& scores) {
    std::map<std::string, MethodScore> beaten = best_of_graphs(scores);
    for (const MethodScore& score : front_of(scores))
        beaten.erase(graph_of(score));
    std::vector<BeatenMethod> out;
    for (const auto& [graph, best] : beaten) {
        const MethodScore* by = nullptr;
        for (const MethodScore& other : scores) {
            if (graph_of(other) == graph || other.error > best.error || other.ms > best.ms) continue;
            if (!by || std::tie(other.ms, other.error) < std::tie(by->ms, by->error)) by = &other;
        }
        if (by) out.push_back({best, *by}); // a twin to the last bit beats nobody
    }
    return out;
}

} // namespace bounce
