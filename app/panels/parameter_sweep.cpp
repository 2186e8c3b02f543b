#include "app/panels/parameter_sweep.h"

#include "app/panels/parameter_widget.h"
#include "app/ui/live_comparison.h"
#include "app/ui/marks.h"
#include "app/ui/settings_key.h"
#include "app/ui/widget_rects.h"
#include "core/error.h"
#include "core/problem.h"
#include "graph/model_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

std::vector<std::string> sweep_values(const ParameterInfo& info, size_t most) {
    if (!info.choices.empty()) return info.choices;
    if (info.kind == ParameterKind::boolean) return {"false", "true"};
    const bool whole = info.kind == ParameterKind::integer;
    if ((!whole && info.kind != ParameterKind::real) || !std::isfinite(info.min) || !std::isfinite(info.max)) return {};
    std::vector<std::string> values;
    for (size_t i = 0; i < most; ++i) {
        const double share = double(i) / double(most - 1);
        double value = info.min + share * (info.max - info.min);
        if (has_logarithmic_slider(info)) value = info.min * std::pow(info.max / info.min, share);
        const std::string text = whole ? fmt::format("{}", std::llround(value)) : fmt::format("{:.4g}", value);
        if (values.empty() || values.back() != text) values.push_back(text);
    }
    return values;
}

void ParameterSweep::start(PanelContext& context, const std::string& name) {
    const Parameter& parameter = context.session.graph().model().parameter(name);
    auto sweep = std::make_shared<ParameterSweep>();
    sweep->name_ = name;
    sweep->values_ = sweep_values(parameter.info);
    if (sweep->values_.empty())
        throw Error("invalid sweep of '" + name + "': expected a number with a range, a choice, or a switch");
    if (context.ui.sweep) context.ui.sweep->stop();
    context.ui.sweep = sweep;
    context.ui.window.ask([context, sweep]() mutable { sweep->step(context); });
}

std::string ParameterSweep::progress() const {
    return fmt::format("{} of {}", points_.size(), values_.size());
}

/// One value: it is set, measured, and put back, so that whatever happens between two steps finds the person's own.
void ParameterSweep::step(PanelContext& context) {
    constexpr int k_frames = 3; // after one that plans and compiles
    Session& session = context.session;
    GraphModel& model = session.graph().model();
    if (!running() || !model.find_parameter(name_)) return;
    const ParameterText before = text_of(name_.substr(0, name_.find('.')), model.parameter(name_));
    Point point;
    point.value = values_[next_++];
    ParameterValue& rebuild = model.graph_parameters().find(k_rebuild)->value;
    const ParameterValue chosen = rebuild;
    try {
        session.set_parameter(name_, point.value, ParameterOrigin::panel);
        point.refused = plan_refusal(session);
        if (point.refused.empty()) {
            rebuild = int(Rebuild::every_frame);
            session.render();
            session.graph().forget_timings();
            for (int i = 0; i < k_frames; ++i)
                session.render();
            session.graph().finish_timings();
            point.ms = whole_frame_ms(session.graph());
            LiveComparison* comparison = context.ui.comparison.get();
            if (comparison && comparison->has_reference() && !comparison->stale(session)) {
                comparison->update(session);
                const auto error = comparison->figures().find(comparison->metric);
                if (error && std::isfinite(*error)) point.error = std::abs(*error);
            }
        }
    } catch (const Error& error) {
        point.refused = error.what();
    } catch (...) {
        rebuild = chosen;
        session.set_parameter(name_, before.text, before.origin);
        throw;
    }
    rebuild = chosen;
    session.set_parameter(name_, before.text, before.origin);
    points_.push_back(std::move(point));
    context.ui.redraw();
    if (!running()) context.ui.say(fmt::format("{} was taken over {} values", name_, points_.size()));
    if (running()) context.ui.window.ask([context, sweep = context.ui.sweep]() mutable { sweep->step(context); });
}

namespace {

/// Points joined from left to right; those that were refused are crosses at the bottom.
void draw_curve(const ParameterSweep& sweep, const char* title, double ParameterSweep::Point::*figure, ImU32 colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 20.0f), ImGui::GetFontSize() * 4);
    ImGui::InvisibleButton(title, size);
    note_widget(std::string("sweep.") + title);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    double top = 0;
    for (const auto& point : sweep.points())
        top = std::max(top, point.*figure);
    const std::string head =
        top > 0 ? fmt::format("{}, top {:.4g}", title, top) : std::string(title) + ": not measured";
    list.AddText({at.x + 4, at.y + 1}, ImGui::GetColorU32(k_dim_colour), head.c_str());
    const auto count = float(std::max<size_t>(sweep.points().size(), 1));
    ImVec2 last{0, 0};
    bool joined = false;
    for (size_t i = 0; i < sweep.points().size(); ++i) {
        const auto& point = sweep.points()[i];
        const float x = at.x + size.x * (float(i) + 0.5f) / count;
        const bool there = point.refused.empty() && point.*figure >= 0 && top > 0;
        const ImVec2 place{x, at.y + size.y - 3 -
                                  (there ? float(point.*figure / top) * (size.y - ImGui::GetFontSize() - 6) : 0)};
        if (there) list.AddCircleFilled(place, 3, colour);
        if (there && joined) list.AddLine(last, place, colour, 1.5f);
        if (!point.refused.empty()) list.AddText({x - 4, at.y + size.y - 16}, ImGui::GetColorU32(k_error_colour), "×");
        last = place, joined = there;
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (ImGui::IsItemHovered() && std::abs(mouse.x - x) < 0.5f * size.x / count) {
            std::string text = sweep.name() + " = " + point.value;
            text += point.refused.empty() ? fmt::format("\n{:.3f} ms", point.ms) : "\n" + point.refused;
            if (point.error >= 0) text += fmt::format("\nerror {:.4g}", point.error);
            show_tooltip(text + "\nClick to set it.");
        }
    }
}

} // namespace

void draw_sweep(PanelContext& context) {
    if (!context.ui.sweep) return;
    const std::shared_ptr<ParameterSweep> sweep = context.ui.sweep;
    show_text(sweep->name() + " over its range: " + sweep->progress(), k_accent_colour);
    note_widget("sweep.title");
    ImGui::SameLine();
    if (ImGui::SmallButton(sweep->running() ? "stop" : "close")) {
        sweep->running() ? sweep->stop() : context.ui.sweep.reset();
        return;
    }
    note_widget("sweep.close");
    draw_curve(*sweep, "ms", &ParameterSweep::Point::ms, ImGui::GetColorU32(k_accent_colour));
    const bool chosen_time = ImGui::IsItemClicked();
    draw_curve(*sweep, "error", &ParameterSweep::Point::error, ImGui::GetColorU32(k_warning_colour));
    const bool chosen = chosen_time || ImGui::IsItemClicked();
    if (chosen && !sweep->points().empty() && !sweep->running()) {
        const ImVec2 min = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
        const float share = (ImGui::GetIO().MousePos.x - min.x) / std::max(size.x, 1.0f);
        const size_t index =
            std::min(size_t(std::max(share, 0.0f) * float(sweep->points().size())), sweep->points().size() - 1);
        const Parameter* parameter = context.session.graph().model().find_parameter(sweep->name());
        if (parameter) {
            const ParameterText before = text_of(sweep->name().substr(0, sweep->name().find('.')), *parameter);
            const ParameterText after{sweep->name(), sweep->points()[index].value, ParameterOrigin::panel};
            if (apply(context.session, context.ui, {after})) push_undo(context, sweep->name(), {before}, {after});
        }
    }
    std::string values;
    for (const auto& point : sweep->points())
        values += (values.empty() ? "" : "  ") + point.value;
    show_wrapped(values, k_dim_colour);
    if (!context.ui.comparison || !context.ui.comparison->has_reference())
        show_wrapped("Render a reference in the Compare panel to see the error, too.", k_dim_colour);
    ImGui::Separator();
}

} // namespace bounce
