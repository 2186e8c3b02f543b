#include "app/experiments/report.h"

#include "app/experiments/svg_scatter.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace bounce {

static std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

static std::string value_of(const ChartPoint& point, const std::string& name) {
    for (auto it = point.task.values.rbegin(); it != point.task.values.rend(); ++it) { // the last one set counts
        if (it->first == name) return it->second;
    }
    return "";
}

static std::vector<std::string> varied_parameters(const std::vector<ChartPoint>& points) {
    std::vector<std::string> names;
    for (const ChartPoint& point : points) {
        for (const auto& [name, value] : point.task.values) {
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
    header.insert(header.end(), {"total_ms",
                                 "mib",
                                 "bounces",
                                 "bias",
                                 "relative_rmse",
                                 "relative_mse",
                                 "p99",
                                 "flip",
                                 "ssim",
                                 "reference_noise",
                                 "full_bias",
                                 "full_relative_rmse",
                                 "full_flip",
                                 "full_reference_noise",
                                 "parts",
                                 "mean",
                                 "reference_mean",
                                 "rmse",
                                 "rmse_without_noise",
                                 "pareto"});
    for (const std::string& pass : passes)
        header.insert(header.end(), {pass + "_ms", pass + "_p10_ms", pass + "_p90_ms"});
    header.insert(header.end(), {"renderer", "commit", "command"});
    for (std::string& name : header)
        name = csv_field(name);
    std::string out = join(header, ",") + "\n";
    for (const ChartPoint& p : points) {
        std::vector<std::string> row = {p.task.shot, p.task.graph, std::to_string(p.task.size.x),
                                        std::to_string(p.task.size.y)};
        for (const std::string& name : names)
            row.push_back(value_of(p, name));
        auto number = [&](double v) { row.push_back(fmt::format("{:.6g}", v)); };
        number(p.total_ms);
        number(double(p.bytes) / 1048576.0);
        row.push_back(p.transport_bounces < 0 ? "all" : std::to_string(p.transport_bounces));
        const PointError& e = p.same_transport;
        for (double v : {e.bias, e.relative_rmse, e.relative_mse, e.p99, e.flip, e.ssim, e.reference_noise, p.full.bias,
                         p.full.relative_rmse, p.full.flip, p.full.reference_noise})
            number(v);
        row.push_back(join(p.parts, "+"));
        for (double v : {e.mean, e.reference_mean, e.rmse, e.rmse_without_noise})
            number(v);
        row.push_back(p.on_front ? "1" : "0");
        for (const std::string& id : passes) {
            auto pass = std::find_if(p.passes.begin(), p.passes.end(), [&](auto& c) { return c.id == id; });
            if (pass == p.passes.end())
                row.insert(row.end(), {"", "", ""});
            else
                for (double v : {pass->median_ms, pass->low_ms, pass->high_ms})
                    number(v);
        }
        row.insert(row.end(), {p.renderer, p.commit, p.task.command()});
        for (std::string& field : row)
            field = csv_field(field);
        out += join(row, ",") + "\n";
    }
    return out;
}

std::string chart_html(const std::vector<ChartPoint>& points, const std::string& against) {
    std::string out =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Bounce: error against "
        "time</title>\n<style>\n"
        "body{font:14px/1.5 sans-serif;margin:2em auto;max-width:1200px;padding:0 1em;color:#222}\n"
        "table{border-collapse:collapse;width:100%}td,th{padding:.3em .6em;border-bottom:1px solid "
        "#ddd;text-align:right;vertical-align:top}\n"
        "td:first-child,th:first-child{text-align:left}code{font-size:12px;background:#f4f4f4;padding:.1em .3em}\n"
        "img{display:block;width:180px;image-rendering:auto}.front td:first-child{border-left:4px solid #0072b2}\n"
        "</style></head><body>\n<h1>Error against time</h1>\n"
        "<p>Errors are measured off depth and normal edges, against a path-traced reference of the graph's own light "
        "transport "
        "(and of all light, where named so). A bar at the left marks points that no other beats in both time and "
        "error.</p>\n";
    out += svg_scatter(points, against);
    out += "<h2>Points</h2>\n<table><tr><th>point</th><th>GPU ms<br>(10 … 90 % by "
           "pass)</th><th>MiB</th><th>bias</th><th>relative RMSE</th><th>99 %</th><th>FLIP</th>"
           "<th>reference noise</th><th>against all light:<br>bias, RMSE</th><th>picture</th><th>relative error, 0 … "
           "50 %</th></tr>\n";
    for (const ChartPoint& p : points) {
        std::string passes;
        for (const PassCost& pass : p.passes)
            passes += fmt::format("{}: {:.3g} ({:.3g} … {:.3g})<br>", escape_markup(pass.id), pass.median_ms,
                                  pass.low_ms, pass.high_ms);
        for (const auto& [id, reason] : p.declined)
            passes += fmt::format("{}: not run, {}<br>", escape_markup(id), escape_markup(reason));
        const PointError& e = p.same_transport;
        const std::string bias = p.absolute() ? fmt::format("{:+.4f} AO", e.mean - e.reference_mean)
                                              : fmt::format("{:+.2f} %", 100 * e.bias);
        const std::string rmse = p.absolute()
                                     ? fmt::format("{:.4f} AO<br>without noise {:.4f}", e.rmse, e.rmse_without_noise)
                                     : fmt::format("{:.2f} %", 100 * e.relative_rmse);
        out += fmt::format(
            "<tr{}><td>{}<br><code>{}</code></td><td><b>{:.3g}</b><br><small>{}</small></td><td>{:.1f}</td><td>{}</"
            "td><td>{}</td><td>{:.1f} %</td>"
            "<td>{:.4f}</td><td>{:.2f} %</td><td>{:+.1f} %, {:.1f} %</td><td><img alt=\"\" "
            "src=\"data:image/png;base64,{}\"></td><td><img alt=\"\" src=\"data:image/png;base64,{}\"></td></tr>\n",
            p.on_front ? " class=\"front\"" : "", escape_markup(p.task.label()), escape_markup(p.task.command()),
            p.total_ms, passes, double(p.bytes) / 1048576.0, bias, rmse, 100 * e.p99, e.flip, 100 * e.reference_noise,
            100 * p.full.bias, 100 * p.full.relative_rmse, p.thumbnail_png, p.error_png);
    }
    std::set<std::string> machines;
    for (const ChartPoint& p : points)
        machines.insert(p.renderer + ", commit " + p.commit);
    out += "</table>\n<p>Measured on:";
    for (const std::string& machine : machines)
        out += "<br>" + escape_markup(machine);
    return out + "</p>\n</body></html>\n";
}

void write_report(std::vector<ChartPoint> points, const std::filesystem::path& folder, const std::string& against) {
    mark_pareto(points);
    std::string json = "[\n";
    for (size_t i = 0; i < points.size(); ++i)
        json += (i ? ",\n" : "") + point_to_json(points[i]);
    write_file_atomically(folder / "chart.csv", chart_csv(points));
    write_file_atomically(folder / "chart.json", json + "]\n");
    write_file_atomically(folder / "chart.svg", svg_scatter(points, against));
    write_file_atomically(folder / "chart.html", chart_html(points, against));
}

} // namespace bounce
