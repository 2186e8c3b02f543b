// The graph: its passes in order, what each costs, what does not run and why.
#include "app/panels/panel.h"
#include "app/panels/pass_switch.h"
#include "app/pass_rows.h"
#include "app/timings.h"
#include "app/ui/marks.h"
#include "app/ui/open.h"
#include "app/ui/settings_key.h"
#include "app/ui/texture_view.h"
#include "app/ui/widget_rects.h"
#include "core/text.h"
#include "gpu/call_watch.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

void draw_choice(PanelContext& context) {
    const GraphFile& file = context.session.graph().model().file();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##graph", context.session.options().graph.c_str())) {
        for (const std::string& name : asset_names("graphs")) {
            if (ImGui::Selectable(name.c_str(), name == file.name)) ask_for_graph(context, name);
            note_widget("graph.choose." + name);
        }
        ImGui::EndCombo();
    }
    note_widget("graph.choose");
    show_tooltip(file.about + "\n" + file.path.string());
    if (ImGui::Checkbox("find NaN", &context.session.graph().check_nan)) context.ui.redraw();
    note_widget("graph.check_nan");
    show_tooltip("Looks at everything that a pass writes for values that are not finite. Slow.");
    ImGui::SameLine();
    bool watched = calls_are_watched();
    ImGui::BeginDisabled(!context.ui.make_gpu_again);
    if (ImGui::Checkbox("find hazards", &watched)) {
        context.ui.window.ask([&ui = context.ui, watched] {
            want_call_watch(watched);
            ui.make_gpu_again();
        });
    }
    ImGui::EndDisabled();
    note_widget("graph.check_hazards");
    show_tooltip("Looks for memory barriers that are missing between passes, which only a GPU would show. The window "
                 "is made again.");
}

/// What a program's own text says, while calls are watched.
void draw_order_problems(const Graph& graph) {
    for (const PlanPass& pass : graph.plan().passes) {
        for (const auto& program : graph.model().nodes()[size_t(pass.node)]->programs) {
            for (const std::string& problem : program->order_problems()) {
                show_wrapped(problem, k_warning_colour);
                note_widget("graph.order_problem");
            }
        }
    }
}

void draw_hazards(const Graph& graph) {
    if (!calls_are_watched()) return;
    const std::vector<std::string>& hazards = hazard_check().hazards();
    ImGui::TextDisabled("%zu hazards", hazards.size());
    note_widget("graph.hazards");
    if (ImGui::IsItemHovered())
        show_tooltip("Commands that need a memory barrier which is missing.\n" + hazard_check().barrier_report());
    const size_t shown = std::min<size_t>(hazards.size(), 5);
    for (size_t i = hazards.size() - shown; i < hazards.size(); ++i)
        show_wrapped(hazards[i], k_error_colour);
    draw_order_problems(graph);
}

void draw_problems(const Graph& graph) {
    for (const GraphProblem& problem : graph.problems()) {
        if (problem.where != "graph") continue;
        show_wrapped(problem.error.text(), k_error_colour);
        note_widget("graph.problem");
    }
}

void draw_switch(PanelContext& context, const std::string& id) {
    const PassNode* node = context.session.graph().model().find_node(id);
    bool on = node && node->enabled;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(1, 1));
    if (ImGui::Checkbox("##enabled", &on)) switch_pass(context, id, on);
    ImGui::PopStyleVar();
    note_widget("graph.enabled." + id);
}

/// A bar to scale with the slowest pass; the thin line on it spans the 10th to the 90th percentile.
void draw_time(const PassTiming& timing, double slowest) {
    ImVec2 from = ImGui::GetCursorScreenPos();
    float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
    auto at = [&](double ms) { return from.x + width * float(slowest > 0 ? std::min(ms / slowest, 1.0) : 0.0); };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (!timing.unchanged && timing.samples > 0) {
        list.AddRectFilled(from, ImVec2(std::max(at(timing.median), from.x + 1), from.y + height),
                           ImGui::GetColorU32(k_bar_colour), 2);
    }
    if (timing.samples > 1 && !timing.unchanged) {
        float y = from.y + height - 2;
        list.AddLine(ImVec2(at(timing.low), y), ImVec2(at(timing.high), y), ImGui::GetColorU32(ImGuiCol_Text), 1);
    }
    if (timing.unchanged)
        show_text(fmt::format(" unchanged ({:.3f})", timing.last), k_dim_colour);
    else if (timing.samples)
        show_text(fmt::format(" {:.3f}", timing.median));
    else
        show_text(timing.last > 0 ? fmt::format(" {:.3f} (old)", timing.last) : " -", k_dim_colour);
}

/// Values of this pass's outputs that were not finite in the newest frame.
uint64_t non_finite_of(const Graph& graph, const PlanPass& pass) {
    uint64_t count = 0;
    for (const PlanSlot& slot : pass.slots) {
        if (!slot.use.writes || slot.resource < 0) continue;
        auto found = graph.non_finite().find(graph.plan().resources[size_t(slot.resource)].name());
        if (found != graph.non_finite().end()) count += found->second;
    }
    return count;
}

/// Its reason takes the place of time and bytes, over both columns: rows keep their height when a pass goes.
void draw_skipped(PanelContext& context, const PassRow& row) {
    draw_switch(context, row.id);
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, k_dim_colour);
    ImGui::Selectable(row.id.c_str(), false, ImGuiSelectableFlags_SpanAllColumns);
    ImGui::PopStyleColor();
    note_widget("graph.pass." + row.id);
    show_tooltip(row.id + " is skipped: " + row.skipped);
    ImGui::TableNextColumn();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImVec2 from = ImGui::GetCursorScreenPos(), window = ImGui::GetWindowPos();
    float right = window.x + ImGui::GetWindowContentRegionMax().x;
    list.PushClipRect(from, ImVec2(right, from.y + ImGui::GetTextLineHeight() + 2), true); // within the panel's own
    list.AddText(from, ImGui::GetColorU32(k_dim_colour), row.skipped.c_str());
    list.PopClipRect();
}

void draw_running(PanelContext& context, const PlanPass& pass, double slowest) {
    Session& session = context.session;
    UiState& ui = context.ui;
    const Graph& graph = session.graph();
    PassTiming timing = graph.timing(pass.id);
    std::string output = main_output(graph.plan(), pass);
    bool stale = graph.pass_is_stale(pass.id), pinned = !output.empty() && ui.pinned == output;
    uint64_t bad = non_finite_of(graph, pass);

    draw_switch(context, pass.id);
    ImGui::SameLine();
    std::string label = pass.id;
    int steps = pass.repeat_to - pass.repeat_from;
    if (steps != 1) label += fmt::format(" ×{}", steps);
    if (stale) label += " (failed)";
    if (bad) label += " (NaN)";
    std::string counted;
    bool overflow = false;
    for (const CounterValue& counter : graph.counters()) {
        if (counter.pass != pass.id) continue;
        counted += fmt::format("\n{} {}", counter.value, counter.label);
        overflow = overflow || counter.bad();
    }
    if (overflow) label += " (overflow)";
    ImVec4 colour = stale || bad || overflow ? k_error_colour
                    : pinned                 ? k_pinned_colour
                                             : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    bool clicked = ImGui::Selectable(label.c_str(), pinned, ImGuiSelectableFlags_SpanAllColumns);
    ImGui::PopStyleColor();
    note_widget("graph.pass." + pass.id);
    if (clicked && !output.empty()) pin(ui, graph, pinned ? "" : output);
    if (ImGui::IsItemHovered()) {
        ui.hovered = output;
        std::string text = pass_details(graph.model(), graph.plan(), pass) + "\n" + time_text(timing) + counted;
        if (bad) text += fmt::format("\n{} values that it wrote are not finite", bad);
        if (stale) text += "\nIts newest program is wrong: see the shaders.";
        if (!output.empty())
            text += pinned ? "\nClick to let go of " + output : "\nClick to keep " + output + " in view";
        show_tooltip(text);
    }
    ImGui::TableNextColumn();
    draw_time(timing, slowest);
    ImGui::TableNextColumn();
    show_right(fmt::format("{:.2f}", double(bytes_of_pass(graph.plan(), pass.id)) / (1 << 20)));
}

void draw_totals(const Session& session) {
    const Graph& graph = session.graph();
    ImGui::TableNextRow(ImGuiTableRowFlags_None);
    ImGui::TableNextColumn();
    show_text(fmt::format("all {} passes", graph.plan().passes.size()), k_dim_colour);
    ImGui::TableNextColumn();
    const bool current = times_are_current(graph);
    show_text(fmt::format(" {:.3f}{}", whole_frame_ms(graph), current ? "" : " (old)"), k_dim_colour);
    note_widget("graph.total_ms");
    show_tooltip(fmt::format("The sum of all passes. Where unchanged ones do not run, a frame takes {:.3f} ms on the "
                             "mean.",
                             graph.frame_ms()));
    ImGui::TableNextColumn();
    show_right(fmt::format("{:.2f}", double(graph.plan().total_bytes()) / (1 << 20)));
    const GpuScene& scene = session.gpu_scene();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    show_text("scene", k_dim_colour);
    show_tooltip("geometry " + format_bytes(double(scene.geometry_bytes())) + ", textures " +
                 format_bytes(double(scene.texture_bytes())));
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    show_right(fmt::format("{:.2f}", double(scene.geometry_bytes() + scene.texture_bytes()) / (1 << 20)));
}

} // namespace

void draw_graph_panel(PanelContext& context) {
    const Graph& graph = context.session.graph();
    draw_choice(context);
    draw_problems(graph);
    draw_hazards(graph);
    double slowest = 0;
    for (const PlanPass& pass : graph.plan().passes)
        slowest = std::max(slowest, graph.timing(pass.id).median);
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 5);
    ImGui::TableSetupColumn("GPU ms", ImGuiTableColumnFlags_WidthStretch, 4);
    ImGui::TableSetupColumn("MiB", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("0000.00").x);
    ImGui::TableHeadersRow();
    for (const PassRow& row : pass_rows(graph.model(), graph.plan())) {
        ImGui::PushID(row.id.c_str());
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (row.plan < 0)
            draw_skipped(context, row);
        else
            draw_running(context, graph.plan().passes[size_t(row.plan)], slowest);
        ImGui::PopID();
    }
    draw_totals(context.session);
    ImGui::EndTable();
}

} // namespace bounce
