#include "app/experiments/tune_page.h"

#include "app/experiments/html_page.h"
#include "app/experiments/page_data.h"
#include "app/experiments/svg_scatter.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

enum class TuneRole { tried, start, found };

struct Told {
    TunePoint point;
    TuneRole role = TuneRole::tried;
    bool front = false;
    glm::ivec2 size{0};
    std::string stage; ///< "full size, 128 × 72"
};

const char* role_name(TuneRole role) {
    return role == TuneRole::start ? "start" : role == TuneRole::found ? "found" : "tried";
}

/// The points of one stage. Those of the settings found are told by `found`.
void add_stage(std::vector<Told>& told, const std::vector<TunePoint>& points, const Variant& found, glm::ivec2 size,
               const char* name) {
    const std::vector<TunePoint> front = tune_front(points);
    for (const TunePoint& point : points) {
        const auto same = [&](const Told& known) { return known.point.variant == point.variant && known.size == size; };
        if (std::any_of(told.begin(), told.end(), same)) continue; // the start may also be a survivor
        Told one{point, TuneRole::tried, false, size, fmt::format("{}, {} × {}", name, size.x, size.y)};
        if (point.variant == found) one.role = TuneRole::found;
        if (point.variant == Variant{}) one.role = TuneRole::start;
        one.front = std::any_of(front.begin(), front.end(), [&](const TunePoint& p) {
            return p.variant == point.variant && p.figures == point.figures;
        });
        told.push_back(std::move(one));
    }
}

std::string command_of(const TuneSettings& settings, const Told& told) {
    SessionOptions session = settings.session;
    std::string text = fmt::format("bounce render {} --graph {} --size {}x{} --frames {}", settings.shots.front(),
                                   session.graph, told.size.x, told.size.y, settings.frames);
    for (const auto& [name, value] : session.sets)
        text += fmt::format(" --set {}={}", name, value);
    for (const auto& [name, value] : told.point.variant.sets)
        text += fmt::format(" --set {}={}", name, value);
    for (const auto& [pass, on] : session.switches)
        text += fmt::format(" {} {}", on ? "--enable" : "--disable", pass);
    return text + " --timings t.json -o x.exr";
}

PagePoint page_point(const TuneOutcome& outcome, const Told& told) {
    PagePoint point;
    point.scene = told.stage;
    point.group = role_name(told.role);
    point.label = told.point.variant.text();
    for (const auto& [name, value] : outcome.own) {
        const auto set = told.point.variant.sets.find(name);
        point.settings.emplace_back(name, set == told.point.variant.sets.end() ? value : set->second);
    }
    const TuneFigures& f = told.point.figures;
    const double mib = f.bytes / 1048576;
    point.numbers = {{"ms", f.ms}, {"mib", mib}, {"error", f.error}};
    point.figures = {{"time, ms", fmt::format("{:.3g}", f.ms)},
                     {"error", fmt::format("{:.2f} %", 100 * f.error)},
                     {"memory, MiB", fmt::format("{:.1f}", mib)}};
    if (told.role != TuneRole::tried) point.mark = role_name(told.role);
    return point;
}

std::string table_row(const TuneSettings& settings, const Told& told, size_t index) {
    const TuneFigures& f = told.point.figures;
    return fmt::format("<tr data-point=\"{}\" class=\"{}{}\"><td><span class=\"name\">{}</span>"
                       "<details><summary>command</summary><code class=\"command\">{}</code></details></td>"
                       "<td>{}</td><td>{}</td><td>{:.3g}</td><td>{:.2f} %</td><td>{:.1f}</td></tr>\n",
                       index, role_name(told.role), told.front ? " front" : "",
                       escape_markup(told.point.variant.text()), escape_markup(command_of(settings, told)),
                       role_name(told.role), told.stage, f.ms, 100 * f.error, f.bytes / 1048576);
}

std::string goal_text(const TuneGoal& goal) {
    std::vector<std::string> limits;
    if (goal.error) limits.push_back(fmt::format("error at most {:.3g} %", 100 * *goal.error));
    if (goal.ms) limits.push_back(fmt::format("at most {:.3g} ms", *goal.ms));
    if (goal.bytes) limits.push_back(fmt::format("at most {:.3g} MiB", *goal.bytes / 1048576));
    if (!goal.error && !goal.ms) limits.insert(limits.begin(), "the start's error at the least time");
    return join(limits, ", ");
}

} // namespace

std::string tune_html(const TuneSettings& settings, const TuneOutcome& outcome, const Origin& origin) {
    const glm::ivec2 size = *settings.session.size;
    const Variant found = outcome.finals.size() > 1 ? outcome.finals[1].variant : Variant{};
    std::vector<Told> all;
    add_stage(all, outcome.search.points, found, tune_first_size(settings), "first stage");
    add_stage(all, outcome.finals, found, size, "full size");
    std::string table;
    PageChart chart;
    for (const Told& told : all) {
        table += table_row(settings, told, chart.points.size());
        chart.points.push_back(page_point(outcome, told));
    }
    chart.scene_title = "measured at";
    chart.unset = "–";
    chart.error = "error";
    chart.costs = {{"ms", "time of a frame, ms"}, {"mib", "memory, MiB"}};
    chart.errors = {{"error", "relative RMSE", true, "", ""}};
    const std::string body =
        "<h1>Settings found by tune</h1>\n<p class=\"origin\">" + escape_markup(origin_head({origin})) + "</p>\n<p>" +
        escape_markup(fmt::format("{} on {}: {} variants of {} parameters. Asked for: {}.", settings.session.graph,
                                  join(settings.shots, ", "), outcome.search.points.size(), outcome.over.size(),
                                  goal_text(settings.goal))) +
        " Points with a bar on the left are beaten in both time and error by no other of their stage.</p>\n"
        "<div class=\"columns\"><div class=\"plot\" id=\"plot\"></div><div class=\"card\" id=\"card\"></div></div>\n"
        "<div id=\"chosen\"></div>\n<h2>Points</h2>\n<table class=\"sortable wide points\" "
        "id=\"points\"><tr><th>settings</th>"
        "<th>role</th><th>measured at</th><th>ms</th><th>error</th><th>MiB</th></tr>\n" +
        table + "</table>";
    return html_page({"settings found by tune", body, page_chart_data(chart), {"pictures", "plot", "chart"}});
}

} // namespace bounce
