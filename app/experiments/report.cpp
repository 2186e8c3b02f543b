#include "app/experiments/report.h"

#include "app/experiments/csv.h"
#include "app/experiments/svg_scatter.h"
#include "app/experiments/transport.h"
#include "app/origin.h"
#include "core/printable.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace bounce {

std::string error_summary(const MetricValues& values, bool occlusion) {
    std::vector<std::string> told;
    for (const char* name : {"bias", "relative_rmse", "relative_rmse_denoised"})
        told.push_back(find_metric(name).title + " " + metric_text(find_metric(name), values, occlusion));
    return join(told, ", ");
}

/// Where the points were measured, and when last.
static std::vector<Origin> origins_of(const std::vector<ChartPoint>& points) {
    std::vector<Origin> origins;
    for (const ChartPoint& p : points) {
        const Origin own{p.content.commit, p.machine, p.renderer, p.driver, p.measured};
        auto known = std::find_if(origins.begin(), origins.end(), [&](const Origin& o) {
            return std::tie(o.commit, o.machine, o.renderer, o.driver) ==
                   std::tie(own.commit, own.machine, own.renderer, own.driver);
        });
        if (known == origins.end())
            origins.push_back(own);
        else
            known->date = std::max(known->date, own.date);
    }
    return origins;
}

static std::string value_of(const ChartPoint& point, const std::string& name) {
    for (auto it = point.task.session.sets.rbegin(); it != point.task.session.sets.rend();
         ++it) { // the last one set counts
        if (it->first == name) return it->second;
    }
    return "";
}

static std::vector<std::string> varied_parameters(const std::vector<ChartPoint>& points) {
    std::vector<std::string> names;
    for (const ChartPoint& point : points) {
        for (const auto& [name, value] : point.task.session.sets) {
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    return names;
}

std::string chart_csv(const std::vector<ChartPoint>& points) {
    std::vector<std::string> names = varied_parameters(points), passes;
    for (const ChartPoint& point : points) {
        for (const PassCost& pass : point.passes) {
            if (std::find(passes.begin(), passes.end(), pass.id) == passes.end()) passes.push_back(pass.id);
        }
    }
    std::vector<std::string> header = {"shot", "graph", "width", "height"};
    header.insert(header.end(), names.begin(), names.end());
    header.insert(header.end(), {"total_ms", "mib", "bounces", "parts"});
    for (const char* against : {"", "full_"}) {
        for (const Metric& metric : metrics())
            header.push_back(against + metric.name);
    }
    const bool thorough = std::any_of(points.begin(), points.end(), [](auto& p) { return p.figures.has_value(); });
    for (const FigureColumn& column : figure_columns())
        if (thorough) header.push_back(column.name);
    header.push_back("pareto");
    for (const std::string& pass : passes)
        header.insert(header.end(), {pass + "_ms", pass + "_p10_ms", pass + "_p90_ms"});
    header.insert(header.end(), {"renderer", "driver", "machine", "measured", "commit", "rebuild", "command"});
    for (std::string& name : header)
        name = csv_field(name);
    std::string out = join(header, ",") + "\n";
    for (const ChartPoint& p : points) {
        std::vector<std::string> row = {p.task.session.shot, p.task.session.graph, std::to_string(p.task.size().x),
                                        std::to_string(p.task.size().y)};
        for (const std::string& name : names)
            row.push_back(value_of(p, name));
        auto number = [&](double v) { row.push_back(fmt::format("{:.6g}", v)); };
        number(p.total_ms);
        number(double(p.bytes) / 1048576.0);
        row.push_back(p.transport_bounces < 0 ? "all" : std::to_string(p.transport_bounces));
        row.push_back(join(p.parts, "+"));
        for (const MetricValues* values : {&p.same_transport, &p.full}) {
            for (const Metric& metric : metrics()) {
                const auto value = values->find(metric.name);
                row.push_back(value ? fmt::format("{:.6g}", *value) : "");
            }
        }
        for (const FigureColumn& column : figure_columns()) {
            const double value = p.figures ? *p.figures.*column.value : MethodFigures::k_none;
            if (thorough) row.push_back(std::isnan(value) ? "" : fmt::format("{:.6g}", value));
        }
        row.push_back(p.on_front ? "1" : "0");
        for (const std::string& id : passes) {
            auto pass = std::find_if(p.passes.begin(), p.passes.end(), [&](auto& c) { return c.id == id; });
            if (pass == p.passes.end())
                row.insert(row.end(), {"", "", ""});
            else
                for (double v : {pass->median_ms, pass->low_ms, pass->high_ms})
                    number(v);
        }
        row.insert(row.end(),
                   {p.renderer, p.driver, p.machine, p.measured, p.content.commit, p.task.rebuild(), p.task.command()});
        for (std::string& field : row)
            field = csv_field(field);
        out += join(row, ",") + "\n";
    }
    return out;
}

std::string chart_markdown(const std::vector<ChartPoint>& points) {
    std::string out = origin_head(origins_of(points)) + "\n| point | ms | MiB |", rule = "| --- | ---: | ---: |";
    for (const Metric* metric : brief_metrics()) {
        out += " " + chart_heading(*metric) + " |";
        rule += " ---: |";
    }
    out += "\n" + rule + "\n";
    for (const ChartPoint& p : points) {
        out += fmt::format("| {} | {:.3g} | {:.1f} |", markdown_cell(p.task.label()), p.total_ms,
                           double(p.bytes) / 1048576.0);
        for (const Metric* metric : brief_metrics())
            out += " " + metric_text(*metric, p.same_transport, p.absolute()) + " |";
        out += "\n";
    }
    return out;
}

std::string head_of(const std::vector<ChartPoint>& points) {
    return origin_head(origins_of(points));
}

std::string with_head(const std::string& svg, const std::vector<ChartPoint>& points) {
    const size_t at = svg.find('\n') + 1; // behind the opening tag
    return svg.substr(0, at) + "<desc>" + escape_markup(origin_head(origins_of(points))) + "</desc>\n" + svg.substr(at);
}

void write_report(std::vector<ChartPoint> points, const std::filesystem::path& folder, const ChartView& view) {
    mark_pareto(points, find_metric(view.metric));
    std::string json = "[\n";
    for (size_t i = 0; i < points.size(); ++i)
        json += (i ? ",\n" : "") + point_to_json(points[i]);
    write_file_atomically(folder / "chart.csv", chart_csv(points));
    write_file_atomically(folder / "chart.json", json + "]\n");
    write_file_atomically(folder / "chart.svg", with_head(svg_scatter(points, view), points));
    write_file_atomically(folder / "chart.md", chart_markdown(points));
    write_file_atomically(folder / "chart.html", chart_html(points, view));
}

} // namespace bounce
