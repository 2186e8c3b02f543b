// The Compare panel: the picture against the truth.
#include "app/experiments/chart.h"
#include "app/experiments/point_content.h"
#include "app/experiments/transport.h"
#include "app/panels/panel.h"
#include "app/ui/point_fronts.h"
#include "app/ui/settings_key.h"
#include "app/ui/style.h"
#include "app/ui/widget_rects.h"
#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <set>

namespace bounce {

/// One for each transport, in the order of their names.
static ImU32 colour_of(const std::vector<ComparePoint>& all, const std::string& transport) {
    static const ImU32 colours[] = {IM_COL32(120, 170, 230, 220), IM_COL32(110, 200, 140, 220),
                                    IM_COL32(205, 140, 190, 220), IM_COL32(210, 200, 110, 220),
                                    IM_COL32(170, 170, 170, 220)};
    std::set<std::string> names;
    for (const ComparePoint& point : all)
        names.insert(point.transport);
    return colours[size_t(std::distance(names.begin(), names.find(transport))) % std::size(colours)];
}

/// The front of each transport, as steps.
template <class ErrorOf, class PlaceOf>
static void draw_fronts(const std::vector<ComparePoint>& all, ErrorOf error_of, PlaceOf place) {
    for (const auto& [transport, front] : pareto_fronts(all, error_of)) {
        const ImU32 colour = colour_of(all, transport);
        for (size_t i = 1; i < front.size(); ++i) {
            const ImVec2 from = place(all[front[i - 1]]), to = place(all[front[i]]);
            ImGui::GetWindowDrawList()->AddLine(from, {to.x, from.y}, colour);
            ImGui::GetWindowDrawList()->AddLine({to.x, from.y}, to, colour);
        }
    }
}

/// Error by the chosen metric against time, both logarithmic: earlier points, and the present one in the accent colour.
static void draw_points(const LiveComparison& comparison, const ComparePoint& live) {
    const bool occlusion = comparison.only_occlusion();
    const Metric& metric = metric_for(find_metric(comparison.metric), occlusion);
    auto error_of = [&](const ComparePoint& p) { return std::abs(p.figures[metric.name] - metric.ideal); };
    auto drawable = [&](const ComparePoint& p) { return p.ms > 0 && error_of(p) > 0 && std::isfinite(error_of(p)); };
    std::vector<ComparePoint> all = comparison.points;
    all.push_back(live);
    double low_x = 1e30, high_x = 0, low_y = 1e30, high_y = 0;
    for (const ComparePoint& p : all) {
        if (!drawable(p)) continue;
        low_x = std::min(low_x, p.ms), high_x = std::max(high_x, p.ms);
        low_y = std::min(low_y, error_of(p)), high_y = std::max(high_y, error_of(p));
    }
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 10);
    ImGui::InvisibleButton("points", size);
    note_widget("compare.points");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(20, 20, 20, 255));
    if (high_x <= 0) return;
    low_x *= 0.7, high_x *= 1.4, low_y *= 0.7, high_y *= 1.4;
    auto place = [&](const ComparePoint& p) {
        float x = float(std::log(p.ms / low_x) / std::log(high_x / low_x)),
              y = float(std::log(error_of(p) / low_y) / std::log(high_y / low_y));
        return ImVec2(at.x + x * size.x, at.y + (1 - y) * size.y);
    };
    draw_fronts(all, error_of, place);
    const ComparePoint* hovered = nullptr;
    for (size_t i = 0; i < all.size(); ++i) {
        const ComparePoint& p = all[i];
        if (!drawable(p)) continue;
        bool is_live = i + 1 == all.size();
        ImVec2 centre = place(p), mouse = ImGui::GetIO().MousePos;
        list->AddCircleFilled(centre, is_live ? 5.0f : 3.5f,
                              is_live ? IM_COL32(255, 170, 60, 255) : colour_of(all, p.transport));
        if (std::hypot(mouse.x - centre.x, mouse.y - centre.y) < 6) hovered = &p;
    }
    const double scale = metric.unit == MetricUnit::share ? 100 : 1;
    std::string corner = fmt::format("{:.2g} … {:.2g} ms,  {} {:.2g} … {:.2g}", low_x, high_x, metric_heading(metric),
                                     scale * low_y, scale * high_y);
    list->AddText({at.x + 6, at.y + 4}, IM_COL32(150, 150, 150, 255), corner.c_str());
    if (hovered)
        ImGui::SetTooltip("%s\n%s\n%.3g ms, %s %s", hovered->label.c_str(), hovered->transport.c_str(), hovered->ms,
                          metric.title.c_str(), metric_text(metric, hovered->figures, occlusion).c_str());
}

/// A row for each metric of the table; a click chooses it for the points.
static void draw_figures(LiveComparison& comparison) {
    const bool occlusion = comparison.only_occlusion();
    bool all = true;
    for (const Metric* metric : brief_metrics()) {
        const Metric& shown = metric_for(*metric, occlusion);
        if (!comparison.figures().find(shown.name)) {
            all = false;
            continue;
        }
        const std::string row =
            fmt::format("{:<15} {:>12}", shown.title, metric_text(shown, comparison.figures(), occlusion));
        if (ImGui::Selectable((row + "##" + shown.name).c_str(), comparison.metric == metric->name))
            comparison.metric = metric->name;
        note_widget("compare.metric." + metric->name);
    }
    ImGui::TextDisabled("%d samples per pixel; off depth and normal edges: %.0f %% of the pixels", comparison.samples(),
                        100 * comparison.kept_share());
    if (!all && ImGui::SmallButton("as seen on a display")) comparison.measure_shown();
    if (!all) note_widget("compare.shown");
}

void draw_compare_panel(PanelContext& context) {
    if (!context.ui.comparison) context.ui.comparison = std::make_shared<LiveComparison>();
    LiveComparison& comparison = *context.ui.comparison;
    Session& session = context.session;

    int full = comparison.full_transport;
    const Transport& transport = session.graph().model().file().transport;
    std::string own = transport.bounces < 0 ? "all light"
                                            : fmt::format("what the graph models ({} bounce{})", transport.bounces,
                                                          transport.bounces == 1 ? "" : "s");
    if (ImGui::RadioButton(own.c_str(), &full, 0)) context.ui.redraw();
    if (ImGui::RadioButton("all light##full", &full, 1)) context.ui.redraw();
    comparison.full_transport = full != 0;
    float percent = 100 * comparison.noise;
    if (ImGui::SliderFloat("noise, %", &percent, 0.1f, 20, "%.1f", ImGuiSliderFlags_Logarithmic))
        comparison.noise = percent / 100;

    if (comparison.running()) {
        ReferenceProgress progress = comparison.progress();
        std::string text = fmt::format("{} samples", progress.samples);
        if (progress.seconds_left >= 0) text += fmt::format(", {:.0f} s left", progress.seconds_left);
        ImGui::ProgressBar(float(progress.share), {-1, 0}, text.c_str());
        if (ImGui::Button("stop")) comparison.stop();
        note_widget("compare.stop");
        context.ui.redraw_panels = true;
    } else {
        bool stale = !comparison.has_reference() || comparison.stale(session);
        if (ImGui::Button(stale ? "render the reference" : "go on")) comparison.start(session);
        note_widget("compare.start");
        if (comparison.has_reference() && stale) ImGui::TextDisabled("the last one is of another view");
    }
    if (std::string problem = comparison.problem(); !problem.empty()) ImGui::TextWrapped("%s", problem.c_str());
    comparison.update(session);
    if (!comparison.has_reference() || comparison.stale(session) || !comparison.measured()) return;

    ImGui::Separator();
    static const char* const views[] = {"off", "split", "flicker", "error", "reference"};
    for (int i = 0; i < 5; ++i) {
        // Those that do not fit beside the others begin another line.
        const float width =
            ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(views[i]).x;
        const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
        if (i && ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= right) ImGui::SameLine();
        if (ImGui::RadioButton(views[i], int(comparison.view) == i)) comparison.view = CompareView(i);
        note_widget(fmt::format("compare.view.{}", views[i]));
        help("Both sides are the same light with the same exposure and tone curve. The reference is the mean over each "
             "pixel, the graph's picture its middle: edges differ.");
    }
    if (comparison.view == CompareView::split) {
        // Its own identity: the button that chooses the view is called "split" too.
        ImGui::SliderFloat("border##split", &comparison.split, 0, 1, "%.2f");
        note_widget("compare.split");
    }
    if (comparison.view == CompareView::error)
        ImGui::SliderFloat("brightest", &comparison.error_range, 0.01f, 4, "%.2f", ImGuiSliderFlags_Logarithmic);
    if (comparison.view == CompareView::flicker) context.ui.redraw_panels = true;
    draw_figures(comparison);

    ImGui::Separator();
    ComparePoint live = comparison.live(session);
    // A time of other settings makes no point.
    const bool current = times_are_current(session.graph());
    if (!current) live.ms = 0;
    draw_points(comparison, live);
    ImGui::BeginDisabled(!current);
    if (ImGui::SmallButton("keep this point")) comparison.points.push_back(live);
    ImGui::EndDisabled();
    note_widget("compare.keep");
    help(current ? "Of the settings that are shown." : "The time of these settings has not been measured yet.");
    ImGui::SameLine();
    if (ImGui::SmallButton("clear")) comparison.points.clear();
    static char folder[512] = "";
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6);
    ImGui::InputTextWithHint("##chart", "folder of a chart", folder, sizeof folder);
    ImGui::SameLine();
    if (ImGui::SmallButton("load chart")) {
        try {
            size_t before = comparison.points.size();
            std::vector<std::string> left_out;
            for (const ChartPoint& point : points_of_one_program(load_points(folder), left_out)) {
                if (point.task.session.shot != session.options().shot) continue;
                const bool all_light = comparison.full_transport;
                comparison.points.push_back({point.task.label(),
                                             all_light ? transport_text(-1, {"out.radiance"})
                                                       : transport_text(point.transport_bounces, point.parts),
                                             point.total_ms, all_light ? point.full : point.same_transport});
            }
            std::string told = fmt::format("{} points of this shot", comparison.points.size() - before);
            if (!left_out.empty()) told += fmt::format("; left out {} of other versions", left_out.size());
            context.ui.say(told);
        } catch (const std::exception& error) {
            context.ui.say(error.what(), true);
        }
    }
}

} // namespace bounce
