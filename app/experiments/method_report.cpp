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
#include <cmath>

namespace bounce {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

static ordered_json number_json(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

static ordered_json metrics_of_page() {
    ordered_json list = ordered_json::array();
    for (const Metric* metric : brief_metrics())
        list.push_back({{"name", metric->name},
                        {"title", metric->title},
                        {"share", metric->unit == MetricUnit::share},
                        {"ideal", metric->ideal},
                        {"absolute", metric->absolute}});
    return list;
}

static ordered_json point_of_page(const MethodSuite& suite, const ChartPoint& point) {
    ordered_json json = {{"shot", point.task.session.shot},
                         {"graph", point.task.session.graph},
                         {"kind", suite.kind_of(point.task.session.graph)},
                         {"occlusion", point.absolute()},
                         {"ms", point.total_ms},
                         {"mib", double(point.bytes) / 1048576},
                         {"command", point.task.command()}};
    json["set"] = ordered_json::object();
    for (const auto& [name, value] : point.task.session.sets)
        json["set"][name] = value;
    json["figures"] = figures_json(point.figures.value_or(MethodFigures()));
    for (const auto& [key, values] : {std::pair("same", &point.same_transport), std::pair("full", &point.full)})
        for (const Metric& metric : metrics())
            json[key][metric.name] = number_json((*values)[metric.name]);
    json["picture"] = point.thumbnail_png;
    json["error"] = point.error_png;
    return json;
}

/// As text of a page's data block: no end of the block can be in it.
static std::string as_data_block(const ordered_json& json) {
    std::string out;
    for (char c : json_dump(json)) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

std::string methods_page(const MethodSuite& suite, const std::vector<ChartPoint>& points, const std::string& head) {
    ordered_json data = {{"head", head}, {"metric", suite.metric}, {"metrics", metrics_of_page()}};
    data["figures"] = ordered_json::array();
    for (const FigureColumn& column : figure_columns())
        data["figures"].push_back({{"name", column.name}, {"title", column.title}, {"unit", column.unit}});
    data["groups"] = ordered_json::array();
    data["points"] = ordered_json::array();
    data["references"] = ordered_json::object();
    for (const MethodGroup& group : suite.groups) {
        data["groups"].push_back({{"name", group.name}, {"title", group.title}});
        for (const MethodScene& scene : suite.scenes) {
            for (const ChartPoint* point : points_of(points, scene, group)) {
                ordered_json json = point_of_page(suite, *point);
                json["group"] = group.name;
                data["references"][scene.shot + " " + group.name] = point->reference_png;
                data["points"].push_back(std::move(json));
            }
        }
    }
    const fs::path path = assets_folder() / "pages" / "methods.html";
    std::string page = read_file(path, k_max_json_text);
    const std::string place = "/*POINTS*/null";
    const size_t at = page.find(place);
    if (at == std::string::npos) throw Error(path.string() + ": expected the text " + place + ", where the points go");
    return page.replace(at, place.size(), as_data_block(data));
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
