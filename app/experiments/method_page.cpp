// The page of all methods: scene, light, error and cost are chosen; a picture that several points share is kept once.
#include "app/experiments/chart_page.h"
#include "app/experiments/html_page.h"
#include "app/experiments/method_report.h"
#include "app/experiments/method_text.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace bounce {

namespace {

/// Figures that are errors of their own.
bool is_error(const FigureColumn& column) {
    const std::string name = column.name;
    return name == "flicker" || name == "shadow_edge_rmse" || name == "direct_rmse";
}

/// Every picture once.
class SharedPictures {
  public:
    explicit SharedPictures(std::vector<std::string>& list) : list_(list) {}
    size_t add(const std::string& png) {
        const auto [found, is_new] = places_.emplace(png, list_.size());
        if (is_new) list_.push_back(png);
        return found->second;
    }

  private:
    std::map<std::string, size_t> places_;
    std::vector<std::string>& list_;
};

PagePoint method_point(const ChartPoint& point, const MethodSuite& suite, const MethodGroup& group,
                       const ChartView& view) {
    PagePoint told = page_point(point, view);
    told.line = group.title;
    told.light = group.name;
    told.kind = suite.kind_of(point.task.session.graph);
    told.command = point.task.command();
    for (const Metric* metric : brief_metrics())
        if (!point.absolute())
            told.numbers.emplace_back("full_" + metric->name, std::abs(point.full[metric->name] - metric->ideal));
    for (const FigureColumn& column : figure_columns()) {
        const double value = point.figures ? *point.figures.*column.value : MethodFigures::k_none;
        if (!std::isfinite(value)) continue;
        const bool share = std::string(column.unit) == "%";
        told.numbers.emplace_back(column.name, value);
        told.figures.emplace_back(column.title, fmt::format("{:.3g} {}", share ? 100 * value : value, column.unit));
    }
    return told;
}

std::vector<PageError> errors_of_page(const ChartView& view) {
    std::vector<PageError> errors = page_errors(view, false);
    for (PageError& error : errors) {
        error.joint_key = "full_" + error.key;
        error.joint_title = find_metric(error.key).title + (error.share ? " in %" : "") + ", all light";
    }
    for (const FigureColumn& column : figure_columns())
        if (is_error(column)) errors.push_back({column.name, column.title, true, "", ""});
    return errors;
}

} // namespace

std::string methods_page(const MethodSuite& suite, const std::vector<ChartPoint>& points, const std::string& head) {
    const ChartView view{"", suite.metric};
    PageChart chart;
    SharedPictures pictures(chart.pictures);
    for (const MethodScene& scene : suite.scenes) {
        for (const MethodGroup& group : suite.groups) {
            for (const ChartPoint* point : points_of(points, scene, group)) {
                PagePoint one = method_point(*point, suite, group, view);
                one.pictures.emplace_back(pictures.add(point->thumbnail_png), "picture");
                one.pictures.emplace_back(pictures.add(point->error_png), "relative error, 0 … 50 %");
                if (!point->reference_png.empty())
                    one.pictures.emplace_back(pictures.add(point->reference_png), "reference");
                chart.points.push_back(std::move(one));
            }
        }
    }
    for (const MethodGroup& group : suite.groups)
        chart.lights.push_back({group.name, group.title});
    chart.scene_title = "scene";
    chart.unset = "as the graph has it";
    chart.error = view.metric;
    chart.errors = errors_of_page(view);
    chart.costs = {{"ms", "a frame, ms"},
                   {"first_ms", "first frame, ms"},
                   {"on_change_ms", "a frame with on_change, ms"},
                   {"mib", "memory, MiB"}};
    chart.kinds = {"published", "tuned", "traced"};
    const std::string body = "<h1>All methods: error against time</h1>\n<p class=\"origin\">" + escape_markup(head) +
                             "</p>\n<noscript><p>This page needs its script; methods.md tells the same in words, and "
                             "methods.csv in figures.</p></noscript>\n<div class=\"columns\"><div class=\"plot\" "
                             "id=\"plot\"></div><div class=\"card\" id=\"card\"></div></div>\n<div "
                             "id=\"chosen\"></div>\n<p class=\"hint\">Error maps: " +
                             heat_scale_markup(0.5) + ".</p>";
    return html_page({"all methods", body, page_chart_data(chart), {"pictures", "plot", "chart"}});
}

} // namespace bounce
