#include "app/ui/point_fronts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bounce {

std::map<std::string, std::vector<size_t>> pareto_fronts(const std::vector<ComparePoint>& points,
                                                         const std::function<double(const ComparePoint&)>& error_of) {
    std::map<std::string, std::vector<size_t>> fronts;
    for (size_t i = 0; i < points.size(); ++i) {
        const double error = error_of(points[i]);
        if (points[i].ms > 0 && error > 0 && std::isfinite(error)) fronts[points[i].transport].push_back(i);
    }
    for (auto& [transport, front] : fronts) {
        auto key = [&](size_t i) { return std::pair(points[i].ms, error_of(points[i])); };
        std::sort(front.begin(), front.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
        double best = std::numeric_limits<double>::infinity();
        std::erase_if(front, [&](size_t i) {
            if (error_of(points[i]) >= best) return true;
            best = error_of(points[i]);
            return false;
        });
    }
    return fronts;
}

} // namespace bounce
