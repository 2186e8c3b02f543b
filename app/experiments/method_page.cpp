// The page of all methods: scene, light, error and cost are chosen; a picture that several points share is kept once.
#include "app/experiments/chart_page.h"
#include "app/experiments/html_page.h"
#include "app/experiments/method_report.h"
#include "app/experiments/method_text.h"
#include "core/json_text.h"
#include "core/printable.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace bounce {

using nlohmann::ordered_json;

namespace {

/// Figures that are errors of their own.
bool is_error(const FigureColumn& column) {
    const std::string name = column.name;
    return name == "flicker" || name == "shadow_edge_rmse" || name == "direct_rmse";
}

/// Every picture once.
class SharedPictures {
  public:
    size_t add(const std::string& png) {
        const auto [found, is_new] = places_.emplace(png, list_.size());
        if (is_new) list_.push_back(png);
        return found->second;
    }
    const ordered_json& list() const { return list_; }

  private:
    std::map<std::string, size_t> places_;
    ordered_json list_ = ordered_json::array();
};

ordered_json method_point(const ChartPoint& point, const MethodSuite& suite, const MethodGroup& group,
                          const ChartView& view) {
    ordered_json told = page_point(point, view);
    told["line"] = group.title;
    told["light"] = group.name;
    told["kind"] = suite.kind_of(point.task.session.graph);
    told["command"] = printable(point.task.command());
    ordered_json& numbers = told["numbers"];
    for (const Metric* metric : brief_metrics()) {
        const double full = std::abs(point.full[metric->name] - metric->ideal);
        if (!point.absolute() && std::isfinite(full)) numbers["full_" + metric->name] = full;
    }
    for (const FigureColumn& column : figure_columns()) {
        const double value = point.figures ? *point.figures.*column.value : MethodFigures::k_none;
        if (!std::isfinite(value)) continue;
        const bool share = std::string(column.unit) == "%";
        numbers[column.name] = value;
        told["figures"].push_back({column.title, fmt::format("{:.3g} {}", share ? 100 * value : value, column.unit)});
    }
    return told;
}

ordered_json errors_of_page(const ChartView& view) {
    ordered_json errors = page_errors(view, false);
    for (ordered_json& error : errors) {
        const std::string key = error["key"];
        error["joint"] = "full_" + key;
        error["joint_title"] = find_metric(key).title + (error["share"].get<bool>() ? " in %" : "") + ", all light";
    }
    for (const FigureColumn& column : figure_columns())
        if (is_error(column)) errors.push_back({{"key", column.name}, {"title", column.title}, {"share", true}});
    return errors;
}

} // namespace

std::string methods_page(const MethodSuite& suite, const std::vector<ChartPoint>& points, const std::string& head) {
    const ChartView view{"", suite.metric};
    SharedPictures pictures;
    ordered_json told = ordered_json::array(), lights = ordered_json::array();
    for (const MethodScene& scene : suite.scenes) {
        for (const MethodGroup& group : suite.groups) {
            for (const ChartPoint* point : points_of(points, scene, group)) {
                ordered_json one = method_point(*point, suite, group, view);
                one["pictures"] = ordered_json::array();
                one["pictures"].push_back({pictures.add(point->thumbnail_png), "picture"});
                one["pictures"].push_back({pictures.add(point->error_png), "relative error, 0 … 50 %"});
                if (!point->reference_png.empty())
                    one["pictures"].push_back({pictures.add(point->reference_png), "reference"});
                told.push_back(std::move(one));
            }
        }
    }
    for (const MethodGroup& group : suite.groups)
        lights.push_back({{"key", group.name}, {"title", printable(group.title)}});
    ordered_json costs = ordered_json::array();
    for (const auto& [key, title] :
         {std::pair("ms", "a frame, ms"), std::pair("first_ms", "first frame, ms"),
          std::pair("on_change_ms", "a frame with on_change, ms"), std::pair("mib", "memory, MiB")})
        costs.push_back({{"key", key}, {"title", title}});
    ordered_json kinds = ordered_json::array({"published", "tuned", "traced"});
    const ordered_json data = {{"scene_title", "scene"}, {"unset", "as the graph has it"},
                               {"costs", costs},         {"errors", errors_of_page(view)},
                               {"error", view.metric},   {"lights", lights},
                               {"kinds", kinds},         {"pictures", pictures.list()},
                               {"points", told}};
    const std::string body = "<h1>All methods: error against time</h1>\n<p class=\"origin\">" + escape_markup(head) +
                             "</p>\n<noscript><p>This page needs its script; methods.md tells the same in words, and "
                             "methods.csv in figures.</p></noscript>\n<div class=\"columns\"><div class=\"plot\" "
                             "id=\"plot\"></div><div class=\"card\" id=\"card\"></div></div>\n<div "
                             "id=\"chosen\"></div>\n<p class=\"hint\">Error maps: " +
                             heat_scale_markup(0.5) + ".</p>";
    return html_page({"all methods", body, json_dump(data), {"pictures", "plot", "chart"}});
}

} // namespace bounce
