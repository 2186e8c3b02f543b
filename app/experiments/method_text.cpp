#include "app/experiments/method_text.h"

#include "app/experiments/transport.h"
#include "core/printable.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace bounce {

namespace {

using Points = std::vector<const ChartPoint*>;

std::string ms_text(double ms) {
    return ms < 10 ? fmt::format("{:.1f} ms", ms) : fmt::format("{:.0f} ms", ms);
}

/// "3.2", "380".
std::string factor_text(double factor) {
    return factor < 9.95 ? fmt::format("{:.2g}", factor) : fmt::format("{:.0f}", factor);
}

/// "3.2 times the", "the same": time.
std::string times_text(double factor) {
    return factor < 1.05 && factor > 0.95 ? "the same" : factor_text(factor) + " times the";
}

std::string settings_of(const ChartPoint& point) {
    std::vector<std::string> told;
    for (const auto& [name, value] : point.task.session.sets)
        told.push_back(name + "=" + value);
    return join(told, " ");
}

/// "`traced` (12 ms, 8.1 %)", with its settings where the graph is in the list more than once.
std::string named(const MethodScore& score, bool settings, const std::string& error) {
    const std::string own = settings ? settings_of(*score.point) : "";
    return fmt::format("`{}` ({}{}, {})", score.point->task.session.graph, own.empty() ? "" : own + ": ",
                       ms_text(score.ms), error);
}

using ErrorText = std::function<std::string(const MethodScore&)>;

std::string front_sentences(const std::vector<MethodScore>& scores, const ErrorText& error) {
    const std::vector<MethodScore> front = front_of(scores);
    std::map<std::string, int> times;
    for (const MethodScore& score : front)
        ++times[score.point->task.session.graph];
    std::vector<std::string> names;
    for (const MethodScore& score : front)
        names.push_back(named(score, times[score.point->task.session.graph] > 1, error(score)));
    if (front.size() == 1) return "One point beats all others in both time and error: " + names.front() + ".";
    const MethodScore &first = front.front(), &last = front.back();
    return fmt::format(
        "On the front, from the fastest to the most accurate: {}. The last takes {} time of the first, and "
        "has 1/{:.2g} of its error.",
        join(names, ", "), times_text(last.ms / first.ms), first.error / last.error);
}

std::string tuning_sentence(const std::vector<MethodScore>& scores) {
    const auto best = best_of_graphs(scores);
    std::vector<std::string> told;
    for (const auto& [graph, score] : best) {
        const auto tuned = best.find(graph + "_tuned");
        if (tuned == best.end() || !(score.error > 0) || !(score.ms > 0)) continue;
        told.push_back(fmt::format("`{}` has {:.2g} of the error of `{}` in {} time", tuned->first,
                                   tuned->second.error / score.error, graph, times_text(tuned->second.ms / score.ms)));
    }
    return told.empty() ? "" : " At their best, " + join(told, "; ") + ".";
}

std::string beaten_sentence(const std::vector<MethodScore>& scores, const ErrorText& error) {
    const std::vector<BeatenMethod> beaten = beaten_everywhere(scores);
    if (beaten.empty()) return " Nobody is beaten everywhere.";
    std::map<std::pair<double, std::string>, std::vector<std::string>> told; // by who beats them, the fastest first
    for (const BeatenMethod& entry : beaten)
        told[{entry.by.ms, named(entry.by, false, error(entry.by))}].push_back(
            fmt::format("`{}` ({} time, {})", entry.best.point->task.session.graph,
                        times_text(entry.best.ms / entry.by.ms), error(entry.best)));
    std::vector<std::string> lists;
    for (const auto& [by, names] : told)
        lists.push_back("by " + by.second + " " + join(names, ", "));
    return " Beaten everywhere, each at its best and by the fastest that is at least as accurate: " +
           join(lists, "; ") + ".";
}

/// The graphs with the least and the most of a figure: by each graph's value that is nearest to its best.
std::string extremes(const Points& points, const std::function<double(const ChartPoint&)>& value,
                     const std::function<std::string(double)>& text, const std::string& least_word,
                     const std::string& most_word) {
    std::map<std::string, double> least;
    for (const ChartPoint* point : points) {
        const double own = value(*point);
        if (!std::isfinite(own)) continue;
        const auto [found, added] = least.emplace(point->task.session.graph, own);
        if (!added) found->second = std::min(found->second, own);
    }
    if (least.size() < 2) return "";
    const auto by_value = [](auto& a, auto& b) { return a.second < b.second; };
    const auto low = std::min_element(least.begin(), least.end(), by_value);
    const auto high = std::max_element(least.begin(), least.end(), by_value);
    return fmt::format("{} `{}` ({}), {} `{}` ({})", least_word, low->first, text(low->second), most_word, high->first,
                       text(high->second));
}

std::string percent(double share) {
    return fmt::format("{:.1f} %", 100 * share);
}

/// Of points that have it.
double figure(const ChartPoint& point, double MethodFigures::*which) {
    return point.figures ? *point.figures.*which : MethodFigures::k_none;
}

/// Memory, first frames, what on_change saves, flicker, edges of shadows: over all points of the scene.
std::string other_sentences(const MethodScene& scene, const Points& points) {
    std::vector<std::string> told;
    const auto add = [&](const std::string& what, const std::string& sentence) {
        if (!sentence.empty()) told.push_back(what + ": " + sentence + ".");
    };
    const auto mib = [](double bytes) { return fmt::format("{:.1f} MiB", bytes / 1048576); };
    const auto times = [](double factor) { return factor_text(factor) + " times"; };
    add("Memory", extremes(
                      points, [](auto& p) { return double(p.bytes); }, mib, "the least has", "the most"));
    add("A first frame against a later one",
        extremes(
            points, [](auto& p) { return figure(p, &MethodFigures::first_ms) / p.total_ms; }, times,
            "cheapest to start is", "dearest"));
    add("A frame with `graph.rebuild=on_change` against one in which all runs",
        extremes(
            points, [](auto& p) { return figure(p, &MethodFigures::on_change_ms) / p.total_ms; }, percent,
            "least is left of", "most of"));
    if (scene.moves)
        add("Flicker", extremes(
                           points, [](auto& p) { return figure(p, &MethodFigures::flicker); }, percent, "steadiest is",
                           "least steady"));
    add("Direct light at the edges of shadows",
        extremes(
            points, [](auto& p) { return figure(p, &MethodFigures::shadow_edge_rmse); }, percent, "the least error has",
            "the most"));
    return join(told, " ");
}

std::string row(const MethodSuite& suite, const MethodScore& best, const std::string& title, const Metric& metric) {
    const ChartPoint& p = *best.point;
    std::string out =
        fmt::format("| `{}` | {} | {} | {} | {:.3g} |", p.task.session.graph, suite.kind_of(p.task.session.graph),
                    title, markdown_cell(settings_of(p)), p.total_ms);
    for (double MethodFigures::*which : {&MethodFigures::first_ms, &MethodFigures::on_change_ms})
        out += std::isfinite(figure(p, which)) ? fmt::format(" {:.3g} |", figure(p, which)) : " – |";
    out += fmt::format(" {:.1f} | {} | {} |", double(p.bytes) / 1048576, error_text(p, metric),
                       p.absolute() ? "–" : metric_text(metric, p.full, false));
    for (double MethodFigures::*which : {&MethodFigures::shadow_edge_rmse, &MethodFigures::flicker})
        out += std::isfinite(figure(p, which)) ? " " + percent(figure(p, which)) + " |" : " – |";
    return out + "\n";
}

} // namespace

Points points_of(const std::vector<ChartPoint>& points, const MethodScene& scene, const MethodGroup& group) {
    Points out;
    for (const ChartPoint& point : points)
        if (point.task.session.shot == scene.shot && group.holds(point)) out.push_back(&point);
    return out;
}

std::string error_text(const ChartPoint& point, const Metric& metric) {
    return metric_text(metric, point.same_transport, point.absolute());
}

std::string group_text(const MethodSuite&, const MethodGroup& group, const Points& points, const Metric& metric) {
    Points lit;
    std::set<std::string> graphs, black;
    for (const ChartPoint* point : points) {
        graphs.insert(point->task.session.graph);
        if (point->same_transport.find("mean") == 0.0)
            black.insert(point->task.session.graph);
        else
            lit.push_back(point);
    }
    if (graphs.empty()) return "";
    const auto scores = scores_of(lit, [&](const ChartPoint& p) { return std::optional(p.error(metric)); });
    const ErrorText error = [&](const MethodScore& score) { return error_text(*score.point, metric); };
    std::string out =
        fmt::format("**{}** ({} points of {} graphs). ", markdown_cell(group.title), points.size(), graphs.size());
    if (!scores.empty())
        out += front_sentences(scores, error) + tuning_sentence(scores) + beaten_sentence(scores, error);
    if (!black.empty())
        out += " Black here, because they make none of this light, and so on no front: `" +
               join({black.begin(), black.end()}, "`, `") + "`.";
    return out + "\n\n";
}

std::string scene_text(const MethodSuite& suite, const MethodScene& scene, const std::vector<ChartPoint>& points,
                       const Metric& metric) {
    Points all, light;
    std::string groups, table;
    std::vector<std::string> absent;
    for (const MethodGroup& group : suite.groups) {
        const Points own = points_of(points, scene, group);
        all.insert(all.end(), own.begin(), own.end());
        const bool meant = group.scenes.empty() ||
                           std::find(group.scenes.begin(), group.scenes.end(), scene.shot) != group.scenes.end();
        if (own.empty() && meant) absent.push_back(group.title);
        groups += group_text(suite, group, own, metric);
        const auto scores = scores_of(own, [&](const ChartPoint& p) { return std::optional(p.error(metric)); });
        for (const auto& [graph, best] : best_of_graphs(scores))
            table += row(suite, best, group.title, metric);
    }
    if (all.empty()) return "";
    std::copy_if(all.begin(), all.end(), std::back_inserter(light), [](auto* p) { return !p->absolute(); });
    const auto scores = scores_of(light, [&](const ChartPoint& p) -> std::optional<double> {
        return std::abs(p.full[metric.name] - metric.ideal);
    });
    std::string whole;
    if (!scores.empty())
        whole = "**Against all light**, whatever a graph models of it. " +
                front_sentences(
                    scores, [&](const MethodScore& score) { return metric_text(metric, score.point->full, false); }) +
                "\n\n";
    if (!absent.empty()) whole += "Not measured on this scene: " + join(absent, "; ") + ".\n\n";
    const glm::ivec2 size = all.front()->task.size();
    const std::string kept =
        fmt::format("{:.0f} % of the pixels lie off edges and count; the reference's own noise is {} in {}.\n\n",
                    100 * all.front()->kept_share, error_text(*all.front(), find_metric("reference_noise")),
                    parts_text(all.front()->parts));
    return fmt::format("## {} ({} × {})\n\n", scene.shot, size.x, size.y) + kept + groups + whole +
           other_sentences(scene, all) +
           "\n\nThe most accurate point of each graph:\n\n"
           "| graph | kind | held to | settings | ms | first frame, ms | on_change, ms | MiB | error | all light | "
           "shadow "
           "edges | flicker |\n| --- | --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n" +
           table + "\n";
}

std::string methods_markdown(const MethodSuite& suite, const std::vector<ChartPoint>& points, const Metric& metric,
                             const std::string& head) {
    std::string out = "# All methods: error against time\n\n" + head + "\n";
    out +=
        "The words below are computed from the measured points. Errors are " +
        std::string(metric.unit == MetricUnit::share ? "relative " : "") + markdown_cell(metric.title) +
        ", off depth and normal edges, against a path-traced reference of the light that a group of methods is held "
        "to; of occlusion they are in AO units. Times are a frame's in which every pass runs. A point is on the front "
        "if no other of its group is both faster and more accurate. Pictures are small: what a graph does at half "
        "resolution counts for more than on a screen.\n\n";
    out += "[methods.html](methods.html) shows the same points to choose from, with their pictures, "
           "[methods.csv](methods.csv) holds them, and [gallery.md](gallery.md) shows pictures at equal time. Charts:";
    for (const MethodGroup& group : suite.groups)
        if (std::any_of(points.begin(), points.end(), [&](auto& p) { return group.holds(p); }))
            out += fmt::format(" [{0}](methods/{1}.svg)", group.title, group.name);
    out += "\n\n";
    std::vector<std::string> absent;
    for (const MethodScene& scene : suite.scenes) {
        const std::string text = scene_text(suite, scene, points, metric);
        if (text.empty()) absent.push_back(scene.shot);
        out += text;
    }
    if (!absent.empty()) out += "Not measured: " + join(absent, ", ") + ".\n";
    return out;
}

} // namespace bounce
