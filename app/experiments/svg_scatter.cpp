#include "app/experiments/svg_scatter.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace bounce {

std::string escape_markup(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

namespace {

constexpr int k_width = 720, k_height = 420, k_left = 70, k_right = 170, k_top = 40, k_bottom = 50;
// A palette that colour-blind readers can tell apart (Okabe and Ito 2008).
const char* const k_colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                 "#e69f00", "#56b4e9", "#000000", "#f0e442"};

/// A logarithmic axis over whole decades or, when the values span less, over 1-2-5 steps.
struct Axis {
    double low = 1, high = 10;

    explicit Axis(std::vector<double> values) {
        std::erase_if(values, [](double v) { return !(v > 0) || !std::isfinite(v); });
        if (values.empty()) return;
        auto [least, most] = std::minmax_element(values.begin(), values.end());
        low = step_below(*least * 0.95);
        high = step_above(*most * 1.05);
    }
    static double step_below(double v) {
        double decade = std::pow(10, std::floor(std::log10(v)));
        for (double s : {5.0, 2.0, 1.0}) {
            if (s * decade <= v) return s * decade;
        }
        return decade;
    }
    static double step_above(double v) {
        double decade = std::pow(10, std::floor(std::log10(v)));
        for (double s : {1.0, 2.0, 5.0, 10.0}) {
            if (s * decade >= v) return s * decade;
        }
        return 10 * decade;
    }
    double share(double v) const {
        return std::clamp((std::log(std::max(v, low)) - std::log(low)) / (std::log(high) - std::log(low)), 0.0, 1.0);
    }
    std::vector<double> ticks() const {
        std::vector<double> out;
        for (double t = low; t <= high * 1.0001; t = step_above(t * 1.0001))
            out.push_back(t);
        return out;
    }
};

std::string plot(const std::string& shot, const std::vector<const ChartPoint*>& points,
                 const std::map<std::string, int>& colours, int top) {
    std::vector<double> times, errors;
    for (const ChartPoint* p : points) {
        times.push_back(p->total_ms);
        errors.push_back(p->same_transport.relative_rmse);
    }
    Axis x_axis(times), y_axis(errors);
    auto x = [&](double ms) { return k_left + x_axis.share(ms) * (k_width - k_left - k_right); };
    auto y = [&](double error) { return top + k_top + (1 - y_axis.share(error)) * (k_height - k_top - k_bottom); };
    double bottom = top + k_height - k_bottom;
    std::string out = fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"15\" font-weight=\"bold\">{}</text>\n", k_left,
                                  top + 24, escape_markup(shot));
    for (double t : x_axis.ticks()) {
        out += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/><text "
                           "x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
                           x(t), top + k_top, bottom, bottom + 16, t);
    }
    for (double t : y_axis.ticks()) {
        out += fmt::format("<line x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/><text x=\"{3}\" "
                           "y=\"{4:.1f}\" text-anchor=\"end\">{5:g} %</text>\n",
                           y(t), k_left, k_width - k_right, k_left - 6, y(t) + 4, 100 * t);
    }
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">GPU time of a frame, ms</text>\n",
                       (k_left + k_width - k_right) / 2, bottom + 36);
    out += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">relative RMSE, same "
                       "transport</text>\n",
                       top + (k_top + k_height - k_bottom) / 2);

    std::vector<const ChartPoint*> front;
    for (const ChartPoint* p : points) {
        if (p->on_front) front.push_back(p);
    }
    std::sort(front.begin(), front.end(), [](auto* a, auto* b) { return a->total_ms < b->total_ms; });
    if (front.size() > 1) {
        std::string path;
        for (size_t i = 0; i < front.size(); ++i) {
            double px = x(front[i]->total_ms), py = y(front[i]->same_transport.relative_rmse);
            path += i == 0 ? fmt::format("M{:.1f} {:.1f}", px, py) : fmt::format(" H{:.1f} V{:.1f}", px, py);
        }
        out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#888\" stroke-dasharray=\"4 3\"/>\n", path);
    }
    for (const ChartPoint* p : points) {
        const char* colour = k_colours[size_t(colours.at(p->task.graph)) % std::size(k_colours)];
        out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" fill-opacity=\"{}\" "
                           "stroke=\"{}\"><title>{}\n{:.3g} ms, {:.2f} %, {:.1f} MiB{}</title></circle>\n",
                           x(p->total_ms), y(p->same_transport.relative_rmse), p->on_front ? 5 : 3.5, colour,
                           p->on_front ? 1.0 : 0.35, colour, escape_markup(p->task.label()), p->total_ms,
                           100 * p->same_transport.relative_rmse, double(p->bytes) / 1048576.0,
                           p->on_front ? ", on the Pareto front" : "");
    }
    int row = 0;
    for (const auto& [graph, index] : colours) {
        int at = top + k_top + 10 + 18 * row++;
        out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
                           k_width - k_right + 18, at, k_colours[size_t(index) % std::size(k_colours)],
                           k_width - k_right + 30, at + 4, escape_markup(graph));
    }
    out += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"#666\">full: on the Pareto front</text>\n",
                       k_width - k_right + 12, top + k_top + 20 + 18 * row);
    return out;
}

} // namespace

std::string svg_scatter(const std::vector<ChartPoint>& points) {
    std::map<std::string, std::vector<const ChartPoint*>> by_shot;
    std::map<std::string, int> colours;
    for (const ChartPoint& point : points) {
        by_shot[point.task.shot].push_back(&point);
        colours.emplace(point.task.graph, 0);
    }
    int index = 0;
    for (auto& [graph, colour] : colours)
        colour = index++;
    int height = k_height * int(std::max<size_t>(by_shot.size(), 1));
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        k_width, height);
    int top = 0;
    for (const auto& [shot, own] : by_shot) {
        out += plot(shot, own, colours, top);
        top += k_height;
    }
    return out + "</svg>\n";
}

} // namespace bounce
