#include "app/experiments/method_report.h"

#include "app/experiments/method_gallery.h"
#include "app/experiments/method_text.h"
#include "app/experiments/report.h"
#include "app/experiments/transport.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/paths.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Names and titles of ours hold nothing that JSON escapes.
static std::string metrics_of_page() {
    std::string list;
    for (const Metric* metric : brief_metrics())
        list += fmt::format("{}{{\"name\":\"{}\",\"title\":\"{}\",\"share\":{},\"ideal\":{},\"absolute\":\"{}\"}}",
                            list.empty() ? "" : ",", metric->name, metric->title, metric->unit == MetricUnit::share,
                            metric->ideal, metric->absolute);
    return list;
}

static std::string figures_of_page() {
    std::string list;
    for (const FigureColumn& column : figure_columns())
        list += fmt::format("{}{{\"name\":\"{}\",\"title\":\"{}\",\"unit\":\"{}\"}}", list.empty() ? "" : ",",
                            column.name, column.title, column.unit);
    return list;
}

/// As text of a page's data block: no end of the block can be in it.
static std::string as_data_block(const std::string& json) {
    std::string out;
    for (char c : json) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

std::string methods_page(const MethodSuite& suite, const std::vector<ChartPoint>& points, const std::string& head) {
    std::string data = "{\"head\":" + json_dump(ordered_json(head)) + ",\"suite\":" + suite.json + ",\"metrics\":[" +
                       metrics_of_page() + "],\"figures\":[" + figures_of_page() + "],\"points\":[";
    for (const MethodScene& scene : suite.scenes) {
        for (const MethodGroup& group : suite.groups) {
            bool first = true;
            for (const ChartPoint* point : points_of(points, scene, group)) {
                ChartPoint told = *point;
                told.passes.clear();
                told.skipped.clear();
                if (!first) told.reference_png.clear(); // all of a group are held to one
                first = false;
                if (data.back() != '[') data += ',';
                data += point_to_json(told);
            }
        }
    }
    const fs::path path = assets_folder() / "pages" / "methods.html";
    std::string page = read_file(path, k_max_json_text);
    const std::string place = "/*POINTS*/null";
    const size_t at = page.find(place);
    if (at == std::string::npos) throw Error(path.string() + ": expected the text " + place + ", where the points go");
    return page.replace(at, place.size(), as_data_block(data + "]}"));
}

static void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error("cannot create the folder '" + folder.string() + "': " + error.message());
}

void write_method_report(const MethodSuite& suite, std::vector<ChartPoint> points, const fs::path& folder,
                         const ChartView& view) {
    const Metric& metric = find_metric(view.metric);
    mark_pareto(points, metric);
    const std::string head = head_of(points);
    make_folder(folder / "methods");
    make_folder(folder / "gallery");
    for (const MethodGroup& group : suite.groups) {
        std::vector<ChartPoint> own;
        std::copy_if(points.begin(), points.end(), std::back_inserter(own), [&](auto& p) { return group.holds(p); });
        if (!own.empty())
            write_file_atomically(folder / "methods" / (group.name + ".svg"), with_head(svg_scatter(own, view), own));
    }
    for (const MethodScene& scene : suite.scenes)
        if (const std::string svg = gallery_svg(suite, scene, points, metric); !svg.empty())
            write_file_atomically(folder / "gallery" / gallery_file(scene), with_head(svg, points));
    write_file_atomically(folder / "methods.csv", chart_csv(points));
    write_file_atomically(folder / "methods.html", methods_page(suite, points, head));
    write_file_atomically(folder / "gallery.md", gallery_markdown(suite, points, metric, head));
    write_file_atomically(folder / "methods.md", methods_markdown(suite, points, metric, head));
}

} // namespace bounce
