// The page of a chart. Its table holds pictures and commands once; the script finds them there.
#include "app/experiments/chart_page.h"
#include "app/experiments/html_page.h"
#include "app/experiments/report.h"
#include "app/experiments/transport.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

std::string chart_heading(const Metric& metric) {
    return metric.absolute.empty() ? metric_heading(metric) : metric.title;
}

namespace {

std::string cost_cell(const ChartPoint& p) {
    std::string passes;
    for (const PassCost& pass : p.passes)
        passes += fmt::format("{}: {:.3g} ({:.3g} … {:.3g})<br>", escape_markup(pass.id), pass.median_ms, pass.low_ms,
                              pass.high_ms);
    for (const auto& [id, reason] : p.skipped)
        passes += fmt::format("{}: skipped: {}<br>", escape_markup(id), escape_markup(reason));
    return fmt::format("<b>{:.3g}</b><details><summary>passes</summary>{}</details>", p.total_ms, passes);
}

/// A parameter's name as a key of `numbers`, apart from those of ours.
const char* const k_against = "against";

/// What a person reads, and what the chart draws.
std::vector<const Metric*> drawn_metrics(const ChartView& view) {
    std::vector<const Metric*> drawn = brief_metrics();
    const Metric* own = &find_metric(view.metric);
    if (std::find(drawn.begin(), drawn.end(), own) == drawn.end()) drawn.push_back(own);
    return drawn;
}

std::vector<PageCost> costs_of(const ChartView& view) {
    std::vector<PageCost> costs;
    if (!view.against.empty()) costs.push_back({k_against, view.against});
    costs.push_back({"ms", "GPU time of a frame, ms"});
    costs.push_back({"mib", "memory, MiB"});
    return costs;
}

std::string table_row(const ChartPoint& p, size_t index) {
    std::string out = fmt::format(
        "<tr data-point=\"{}\"{}><td><b class=\"name\">{}</b><br><small>{}</small>"
        "<details><summary>command</summary><code class=\"command\">{}</code></details></td><td>{}</td><td>{:.1f}</td>",
        index, p.on_front ? " class=\"front\"" : "", escape_markup(p.task.label()),
        escape_markup(transport_text(p.transport_bounces, p.parts)), escape_markup(p.task.command()), cost_cell(p),
        double(p.bytes) / 1048576.0);
    for (const Metric* metric : brief_metrics()) {
        out += "<td>" + metric_text(*metric, p.same_transport, p.absolute());
        if (!p.absolute()) out += "<br><small>" + metric_text(*metric, p.full, false) + "</small>";
        out += "</td>";
    }
    return out + "<td>" + png_markup(p.thumbnail_png, "picture") + "</td><td>" +
           png_markup(p.error_png, "relative error, 0 … 50 %") + "</td></tr>\n";
}

} // namespace

std::vector<PageError> page_errors(const ChartView& view, bool occlusion) {
    std::vector<PageError> errors;
    for (const Metric* brief : drawn_metrics(view)) {
        const Metric& metric = metric_for(*brief, occlusion);
        errors.push_back({brief->name, error_title(metric, occlusion), metric.unit == MetricUnit::share, "", ""});
    }
    return errors;
}

PagePoint page_point(const ChartPoint& p, const ChartView& view) {
    PagePoint point;
    point.scene = p.task.session.shot;
    point.group = p.task.session.graph;
    point.line = transport_text(p.transport_bounces, p.parts);
    point.label = p.task.label();
    point.settings = p.task.session.sets;
    for (const auto& [id, on] : p.task.session.switches)
        point.settings.emplace_back(id, on ? "on" : "off");
    point.settings.emplace_back("size", fmt::format("{} × {}", p.task.size().x, p.task.size().y));
    const double mib = double(p.bytes) / 1048576.0;
    point.numbers = {{"ms", p.total_ms}, {"mib", mib}};
    if (!view.against.empty()) point.numbers.emplace_back(k_against, parameter_of(p, view.against));
    point.figures = {{"GPU time, ms", fmt::format("{:.3g}", p.total_ms)}, {"memory, MiB", fmt::format("{:.1f}", mib)}};
    for (const Metric* metric : drawn_metrics(view)) {
        point.numbers.emplace_back(metric->name, p.error(*metric));
        point.figures.emplace_back(metric->title, metric_text(*metric, p.same_transport, p.absolute()));
    }
    for (const PassCost& pass : p.passes)
        point.passes.emplace_back(pass.id, fmt::format("{:.3g}", pass.median_ms));
    return point;
}

std::string chart_html(const std::vector<ChartPoint>& points, const ChartView& view) {
    bool occlusion = !points.empty();
    PageChart chart;
    std::string table;
    for (const ChartPoint& p : points) {
        occlusion = occlusion && p.absolute();
        table += table_row(p, chart.points.size());
        chart.points.push_back(page_point(p, view));
    }
    std::string body =
        "<h1>Error against time</h1>\n<p class=\"origin\">" + escape_markup(head_of(points)) +
        "</p>\n<div class=\"columns\"><div class=\"plot\" id=\"plot\">\n" + svg_scatter(points, view) +
        "</div><div class=\"card\" id=\"card\"></div></div>\n<div id=\"chosen\"></div>\n"
        "<h2>Points</h2>\n<p class=\"hint\">Errors are measured off depth and normal edges, against a "
        "path-traced reference of the graph's own light transport; in small print, against one of all "
        "light. Points with a bar on the left are beaten in both time and error by no other of the same "
        "light transport, which stands under each. Error maps: " +
        heat_scale_markup(0.5) +
        ".</p>\n<table class=\"sortable wide points\" id=\"points\"><tr><th>point</th><th>GPU ms</th><th>MiB</th>";
    for (const Metric* metric : brief_metrics())
        body += "<th>" + escape_markup(chart_heading(*metric)) + "</th>";
    body += "<th class=\"plain\">picture</th><th class=\"plain\">relative error</th></tr>\n" + table + "</table>";
    chart.scene_title = "shot";
    chart.unset = "as the graph has it";
    chart.error = view.metric;
    chart.costs = costs_of(view);
    chart.errors = page_errors(view, occlusion);
    return html_page({"error against time", body, page_chart_data(chart), {"pictures", "plot", "chart"}});
}

} // namespace bounce
