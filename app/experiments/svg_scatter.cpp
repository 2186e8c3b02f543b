#include "app/experiments/svg_scatter.h"

#include "app/experiments/transport.h"
#include "core/printable.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <map>

namespace bounce {

std::string escape_markup(const std::string& text) {
    std::string out;
    for (char c : printable(text)) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += c;
    }
    return out;
}

double parameter_of(const ChartPoint& point, const std::string& against) {
    for (auto it = point.task.session.sets.rbegin(); it != point.task.session.sets.rend();
         ++it) { // the last one set counts
        if (it->first == against || it->first.ends_with("." + against)) return std::atof(it->second.c_str());
    }
    return 0;
}

std::string error_title(const Metric& metric, bool occlusion) {
    std::string title = metric.ideal == 0 ? metric.title : fmt::format("{:g} - {}", metric.ideal, metric.title);
    if (metric.format.starts_with("+")) title = "|" + title + "|";
    if (metric.unit == MetricUnit::share) title += " in %";
    if (occlusion) return title + (metric.unit == MetricUnit::image ? " in AO units" : ", occlusion");
    return title + ", same transport";
}

namespace {

constexpr int k_width = 720, k_height = 420, k_left = 70, k_right = 170, k_top = 40, k_bottom = 50;
// A palette that colour-blind readers can tell apart (Okabe and Ito 2008).
const char* const k_colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                 "#e69f00", "#56b4e9", "#000000", "#f0e442"};

/// The mark of the index-th graph: a colour of its own, and where these are used up another shape. `inside`: its title.
std::string mark(int index, double x, double y, double radius, double opacity, const std::string& inside) {
    const size_t colours = std::size(k_colours);
    const std::string look =
        fmt::format("fill=\"{0}\" fill-opacity=\"{1}\" stroke=\"{0}\"", k_colours[size_t(index) % colours], opacity);
    const double r = 1.1 * radius;
    switch (size_t(index) / colours % 3) {
    case 0:
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}>{}</circle>\n", x, y, radius, look, inside);
    case 1:
        return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}>{}</rect>\n", x - r,
                           y - r, 2 * r, 2 * r, look, inside);
    default:
        return fmt::format("<path d=\"M{:.1f} {:.1f} l{:.1f} {:.1f} h{:.1f} z\" {}>{}</path>\n", x, y - 1.3 * r,
                           1.3 * r, 2.2 * r, -2.6 * r, look, inside);
    }
}

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

/// Of the fronts of different transports.
const char* const k_dashes[] = {"4 3", "1 3", "10 3", "10 3 1 3", "6 2 1 2 1 2"};

/// Joins the points from left to right: a Pareto front as steps, or each graph's own as lines.
std::string joined(std::vector<std::pair<double, double>> points, bool steps, const char* colour,
                   const char* dashes = k_dashes[0]) {
    std::sort(points.begin(), points.end());
    if (points.size() < 2) return "";
    std::string path;
    for (size_t i = 0; i < points.size(); ++i) {
        const auto& [x, y] = points[i];
        if (i == 0)
            path = fmt::format("M{:.1f} {:.1f}", x, y);
        else
            path += steps ? fmt::format(" H{:.1f} V{:.1f}", x, y) : fmt::format(" L{:.1f} {:.1f}", x, y);
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-dasharray=\"{}\"/>\n", path, colour, dashes);
}

std::string transport_of(const ChartPoint& point) {
    return transport_text(point.transport_bounces, point.parts);
}

std::string plot(const std::string& shot, const std::vector<const ChartPoint*>& points,
                 const std::map<std::string, int>& colours, int top, const ChartView& view) {
    const std::string& against = view.against;
    const bool absolute = std::all_of(points.begin(), points.end(), [](auto* p) { return p->absolute(); });
    const Metric& metric = metric_for(find_metric(view.metric), absolute);
    const bool share = metric.unit == MetricUnit::share;
    auto error_of = [&](const ChartPoint* p) { return std::abs(p->same_transport[metric.name] - metric.ideal); };
    auto place_of = [&](const ChartPoint* p) { return against.empty() ? p->total_ms : parameter_of(*p, against); };
    std::vector<double> places, errors;
    for (const ChartPoint* p : points) {
        places.push_back(place_of(p));
        errors.push_back(error_of(p));
    }
    Axis x_axis(places), y_axis(errors);
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
                           "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                           y(t), k_left, k_width - k_right, k_left - 6, y(t) + 4,
                           share ? fmt::format("{:g} %", 100 * t) : fmt::format("{:g}", t));
    }
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", (k_left + k_width - k_right) / 2,
                       bottom + 36, against.empty() ? "GPU time of a frame, ms" : escape_markup(against));
    out += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       top + (k_top + k_height - k_bottom) / 2, escape_markup(error_title(metric, absolute)));

    std::map<std::string, std::vector<std::pair<double, double>>> fronts, lines; // of transports; of graphs
    for (const ChartPoint* p : points) {
        const std::pair<double, double> at{x(place_of(p)), y(error_of(p))};
        std::vector<std::pair<double, double>>& front = fronts[transport_of(*p)];
        if (p->on_front) front.push_back(at);
        lines[p->task.session.graph].push_back(at);
    }
    if (against.empty()) {
        size_t index = 0;
        for (const auto& [transport, front] : fronts)
            out += joined(front, true, "#888", k_dashes[index++ % std::size(k_dashes)]);
    } else {
        for (const auto& [graph, line] : lines)
            out += joined(line, false, k_colours[size_t(colours.at(graph)) % std::size(k_colours)]);
    }
    for (const ChartPoint* p : points) {
        const std::string title =
            fmt::format("<title>{}\n{:.3g} ms, {}, {:.1f} MiB{}</title>", escape_markup(p->task.label()), p->total_ms,
                        escape_markup(metric.title + " " + metric_text(metric, p->same_transport, absolute)),
                        double(p->bytes) / 1048576.0,
                        p->on_front ? escape_markup(", on the Pareto front of " + transport_of(*p)) : "");
        out += mark(colours.at(p->task.session.graph), x(place_of(p)), y(error_of(p)), p->on_front ? 5 : 3.5,
                    p->on_front ? 1.0 : 0.35, title);
    }
    int row = 0;
    for (const auto& [graph, index] : colours) {
        int at = top + k_top + 10 + 18 * row++;
        out += mark(index, k_width - k_right + 18, at, 5, 1, "");
        out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", k_width - k_right + 30, at + 4, escape_markup(graph));
    }
    out += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"#666\">full: on the Pareto front</text>\n",
                       k_width - k_right + 12, top + k_top + 20 + 18 * row);
    size_t index = 0;
    for (const auto& [transport, front] : fronts) {
        if (fronts.size() == 1 || !against.empty()) break;
        const int at = top + k_top + 20 + 18 * ++row;
        out += fmt::format("<path d=\"M{} {} h22\" stroke=\"#888\" stroke-dasharray=\"{}\"/>", k_width - k_right + 12,
                           at - 4, k_dashes[index++ % std::size(k_dashes)]);
        out += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"#666\" font-size=\"10\">{}</text>\n", k_width - k_right + 38,
                           at, escape_markup(transport));
    }
    return out;
}

} // namespace

std::string svg_scatter(const std::vector<ChartPoint>& points, const ChartView& view) {
    const std::string& against = view.against;
    std::map<std::string, std::vector<const ChartPoint*>> by_shot;
    std::map<std::string, int> colours;
    for (const ChartPoint& point : points) {
        if (!against.empty() && !(parameter_of(point, against) > 0)) continue; // no place on a logarithmic axis
        by_shot[point.task.session.shot].push_back(&point);
        colours.emplace(point.task.session.graph, 0);
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
        out += plot(shot, own, colours, top, view);
        top += k_height;
    }
    return out + "</svg>\n";
}

} // namespace bounce
