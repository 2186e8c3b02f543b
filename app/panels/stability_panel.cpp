// A case of the stability suite on the shown graph, and its curve.
#include "app/experiments/stability_report.h"
#include "app/panels/panel.h"
#include "app/ui/marks.h"
#include "app/ui/stability_run.h"
#include "app/ui/widget_rects.h"
#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace bounce {

namespace {

/// Values over the ladder, from the least or 0 to the largest or the mark, which is dashed.
void draw_curve(const StabilityMeasurement& measurement) {
    const StabilityCase& which = measurement.which();
    const std::vector<double>& curve = measurement.curve();
    const bool marked = which.summary != StabilitySummary::growth;
    double low = 0, high = marked ? which.most : 0;
    for (double value : curve)
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 8);
    ImGui::InvisibleButton("curve", size);
    note_widget("stability.curve");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(20, 20, 20, 255));
    if (!(high > low)) return;
    const float steps = float(std::max<size_t>(which.ladder.size(), 2) - 1);
    const auto place = [&](size_t i, double value) {
        return ImVec2(at.x + 8 + (size.x - 16) * float(i) / steps,
                      at.y + size.y - 6 - (size.y - 12) * float((value - low) / (high - low)));
    };
    if (marked)
        for (float x = 0; x < size.x; x += 8)
            list->AddLine({at.x + x, place(0, which.most).y}, {at.x + x + 4, place(0, which.most).y},
                          IM_COL32(150, 150, 150, 255));
    for (size_t i = 0; i < curve.size(); ++i) {
        const ImVec2 here = place(i, std::isfinite(curve[i]) ? curve[i] : high);
        list->AddCircleFilled(here, 3.5f, IM_COL32(255, 170, 60, 255));
        if (i > 0) list->AddLine(place(i - 1, curve[i - 1]), here, IM_COL32(255, 170, 60, 255), 1.5f);
    }
}

void draw_values(const StabilityMeasurement& measurement) {
    const StabilityCase& which = measurement.which();
    for (size_t i = 0; i < measurement.curve().size(); ++i)
        show_text(fmt::format("{:g} {}: {}", which.ladder[i], which.unit.empty() ? which.step : which.unit,
                              stability_text(which, measurement.curve()[i], false)));
    if (!measurement.done()) return;
    StabilityCell cell;
    cell.figure = summary_of(which.summary, measurement.curve());
    cell.reached = std::abs(*cell.figure) <= which.most;
    show_text(fmt::format("{} {}: {} (mark {})", name_of(which.summary), name_of(which.quantity),
                          stability_text(which, *cell.figure, true), stability_text(which, which.most, true)),
              cell.reached ? k_good_colour : k_error_colour);
}

} // namespace

void draw_stability_panel(PanelContext& context) {
    if (!context.ui.stability) context.ui.stability = std::make_shared<StabilityRun>();
    StabilityRun& run = *context.ui.stability;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##case", run.chosen.c_str())) {
        for (const std::string& name : stability_case_names())
            if (ImGui::Selectable(name.c_str(), name == run.chosen)) run.chosen = name;
        ImGui::EndCombo();
    }
    note_widget("stability.case");
    if (run.running()) {
        if (ImGui::Button("stop")) run.stop();
        note_widget("stability.stop");
    } else {
        if (ImGui::Button("run")) context.ui.window.ask([&run, &session = context.session] { run.start(session); });
        note_widget("stability.run");
        help("The case on this graph as it is set now. The window stands still while a step of it is measured.");
    }
    const StabilityMeasurement* measurement = run.measurement();
    if (!measurement) return;
    ImGui::SameLine();
    show_text(fmt::format("{}, {}: {} of {}", measurement->which().name, run.graph(), measurement->curve().size(),
                          measurement->which().ladder.size()));
    show_wrapped(measurement->which().about, k_dim_colour);
    if (!run.problem().empty()) show_wrapped("not measured: " + run.problem(), k_error_colour);
    if (run.stale(context.session)) {
        show_wrapped("of earlier settings: the graph or its values are others now", k_warning_colour);
        note_widget("stability.stale");
    }
    draw_curve(*measurement);
    draw_values(*measurement);
    if (!run.running()) return;
    context.ui.redraw_panels = true;
    context.ui.window.ask([&run] { run.step(); });
}

} // namespace bounce
