#include "app/experiments/method_figures.h"

#include "app/experiments/flicker.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bounce {

namespace {

constexpr double k_dark = 0.05; ///< of the brightest pixel around: a shadow

double luminance(const float* v) {
    return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
}

bool at_shadow_edge(const Image& light, const Mask& mask, int x, int y) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, light.height - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, light.width - 1); ++i) {
            if (!mask.keep[size_t(j) * size_t(light.width) + size_t(i)]) continue;
            least = std::min(least, luminance(light.at(i, j)));
            most = std::max(most, luminance(light.at(i, j)));
        }
    }
    return most > 0 && least < k_dark * most;
}

/// Root of the mean square over the mean.
struct Sum {
    double squares = 0, reference = 0;
    size_t pixels = 0;
    double relative() const {
        return reference > 0 ? std::sqrt(squares * double(pixels)) / reference : MethodFigures::k_none;
    }
};

} // namespace

void add_shadow_errors(MethodFigures& figures, const Image& direct, const Image& reference, const Mask& mask) {
    Sum edge, rest;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            if (!mask.keep[size_t(y) * size_t(reference.width) + size_t(x)]) continue;
            Sum& sum = at_shadow_edge(reference, mask, x, y) ? edge : rest;
            const double truth = luminance(reference.at(x, y));
            sum.squares += std::pow(luminance(direct.at(x, y)) - truth, 2);
            sum.reference += truth;
            ++sum.pixels;
        }
    }
    const size_t all = edge.pixels + rest.pixels;
    if (all == 0) return;
    figures.shadow_edge_share = double(edge.pixels) / double(all);
    figures.shadow_edge_rmse = edge.relative();
    figures.direct_rmse = rest.relative();
}

void add_steady_figures(MethodFigures& figures, Session& session, const std::string& resource) {
    session.set_parameter("graph.rebuild", "on_change", ParameterOrigin::command_line);
    session.advance();
    session.render(true); // all runs once more
    session.graph().forget_timings();
    session.advance();
    const bool there = session.graph().texture(resource) != nullptr;
    figures.flicker = measure_flicker(session, there ? resource : "out.radiance", 3).flicker;
    session.graph().finish_timings();
    figures.on_change_ms = session.graph().frame_ms();
}

const std::vector<FigureColumn>& figure_columns() {
    static const std::vector<FigureColumn> columns = {
        {"first_ms", "first frame", "ms", &MethodFigures::first_ms},
        {"on_change_ms", "on_change", "ms", &MethodFigures::on_change_ms},
        {"flicker", "flicker", "%", &MethodFigures::flicker},
        {"shadow_edge_share", "pixels at shadow edges", "%", &MethodFigures::shadow_edge_share},
        {"shadow_edge_rmse", "direct at shadow edges", "%", &MethodFigures::shadow_edge_rmse},
        {"direct_rmse", "direct elsewhere", "%", &MethodFigures::direct_rmse},
    };
    return columns;
}

nlohmann::ordered_json figures_json(const MethodFigures& figures) {
    nlohmann::ordered_json json;
    for (const FigureColumn& column : figure_columns()) {
        const double value = figures.*column.value;
        json[column.name] = std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    }
    return json;
}

MethodFigures figures_from_json(const nlohmann::ordered_json& json) {
    MethodFigures figures;
    for (const FigureColumn& column : figure_columns()) {
        const auto& value = json.at(column.name);
        if (value.is_number()) figures.*column.value = value.get<double>();
    }
    return figures;
}

} // namespace bounce
