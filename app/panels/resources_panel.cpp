// Every texture and buffer of the graph, and how the chosen one is shown.
#include "app/panels/panel.h"
#include "app/panels/viewer_settings.h"
#include "app/pass_rows.h"
#include "app/ui/marks.h"
#include "app/ui/texture_view.h"
#include "app/ui/widget_rects.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

enum Column { k_name, k_format, k_size, k_mips, k_bytes, k_writers, k_readers, k_kept, k_columns };

std::string kept_text(const PlanResource& resource) {
    std::vector<std::string> words;
    if (resource.declaration.persistent) words.push_back("persistent");
    if (resource.declaration.incremental) words.push_back("incremental");
    if (resource.needs_previous) words.push_back("last frame's copy");
    return join(words, ", ");
}

void choose(UiState& ui, const Graph& graph, const PlanResource& resource) {
    if (resource.is_buffer()) {
        bool same = ui.buffer.resource == resource.name();
        ui.buffer = {same ? "" : resource.name(), 0, ui.buffer.words};
        return;
    }
    ui.buffer.resource.clear();
    pin(ui, graph, ui.pinned == resource.name() ? "" : resource.name());
}

/// A row is as wide as all columns, shown or not, and between columns one grabs their border: its name is what to
/// press.
void note_row(const std::string& name) {
    ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    if (!ImGui::IsRectVisible(min, max)) return;
    note_rectangle("resources.row." + name, min.x, min.y, min.x + ImGui::CalcTextSize(name.c_str()).x, max.y);
}

void draw_row(PanelContext& context, const PlanResource& resource) {
    UiState& ui = context.ui;
    bool buffer = resource.is_buffer();
    bool chosen = buffer ? ui.buffer.resource == resource.name() : ui.pinned == resource.name();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(resource.name().c_str(), chosen, ImGuiSelectableFlags_SpanAllColumns))
        choose(ui, context.session.graph(), resource);
    note_row(resource.name());
    if (ImGui::IsItemHovered()) {
        std::string kept = kept_text(resource);
        std::string text = resource.name() + ": " + resource_text(resource);
        text += "\nwritten by " + (resource.writers.empty() ? "nobody" : join(resource.writers, ", "));
        text += "\nread by " + (resource.readers.empty() ? "nobody" : join(resource.readers, ", "));
        if (!kept.empty()) text += "\n" + kept;
        show_tooltip(text + (buffer   ? "\nClick to see its words."
                             : chosen ? "\nClick to let go."
                                      : "\nClick to keep it in view."));
    }
    auto cell = [](const std::string& text) {
        ImGui::TableNextColumn();
        show_text(text);
    };
    cell(buffer ? "buffer" : resource.declaration.format);
    cell(size_text(resource));
    cell(buffer || resource.texture.mips == 1 ? "" : std::to_string(resource.texture.mips));
    ImGui::TableNextColumn();
    show_right(format_bytes(double(resource.total_bytes())));
    cell(join(resource.writers, ", "));
    cell(join(resource.readers, ", "));
    cell(kept_text(resource));
}

/// In the plan's order unless a column's head was clicked.
std::vector<const PlanResource*> sorted(const Plan& plan) {
    std::vector<const PlanResource*> rows;
    for (const PlanResource& resource : plan.resources)
        rows.push_back(&resource);
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (!specs || specs->SpecsCount == 0) return rows;
    bool down = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    auto sort_by = [&](auto key) {
        std::stable_sort(rows.begin(), rows.end(),
                         [&](auto* a, auto* b) { return down ? key(*b) < key(*a) : key(*a) < key(*b); });
    };
    if (specs->Specs[0].ColumnIndex == k_bytes)
        sort_by([](const PlanResource& r) { return r.total_bytes(); });
    else
        sort_by([](const PlanResource& r) { return r.name(); });
    return rows;
}

void draw_table(PanelContext& context, float height) {
    const Plan& plan = context.session.graph().plan();
    ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX |
                            ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate |
                            ImGuiTableFlags_Resizable | ImGuiTableFlags_Hideable | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable("resources", k_columns, flags, ImVec2(0, height))) return;
    ImGui::TableSetupScrollFreeze(1, 1);
    ImGui::TableSetupColumn("resource", ImGuiTableColumnFlags_NoHide);
    for (const char* name : {"format", "size", "mips"})
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_NoSort);
    ImGui::TableSetupColumn("bytes", ImGuiTableColumnFlags_PreferSortDescending);
    for (const char* name : {"written by", "read by", "kept"})
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_NoSort);
    ImGui::TableHeadersRow();
    for (const PlanResource* resource : sorted(plan))
        draw_row(context, *resource);
    ImGui::EndTable();
}

void draw_counts(const Plan& plan) {
    const LiveObjects& live = live_objects();
    show_text(fmt::format("{} resources, {}", plan.resources.size(), format_bytes(double(plan.total_bytes()))));
    ImGui::SameLine();
    show_text(fmt::format("{} GPU objects", live.total()), k_dim_colour);
    note_widget("resources.live");
    show_tooltip(fmt::format(
        "alive now: {} textures, {} views, {} buffers, {} framebuffers, {} samplers, {} vertex arrays, {} programs, "
        "{} queries",
        live.textures, live.views, live.buffers, live.framebuffers, live.samplers, live.vertex_arrays, live.programs,
        live.queries));
}

} // namespace

void draw_resources_panel(PanelContext& context) {
    const Plan& plan = context.session.graph().plan();
    UiState& ui = context.ui;
    const PlanResource* buffer = ui.buffer.resource.empty() ? nullptr : plan.find_resource(ui.buffer.resource);
    const PlanResource* texture = ui.viewer.resource.empty() ? nullptr : plan.find_resource(ui.viewer.resource);
    if (buffer && !buffer->is_buffer()) buffer = nullptr;
    if (texture && texture->is_buffer()) texture = nullptr;
    draw_counts(plan);

    // The same room whether one is chosen or not, so that rows stay under the pointer; a volume's mips and slices take
    // more.
    float line = ImGui::GetFrameHeightWithSpacing();
    int lines = 9 + (texture && texture->texture.mips > 1) + (texture && texture->texture.size.z > 1);
    float below = buffer ? ImGui::GetContentRegionAvail().y * 0.5f : line * float(lines);
    float wanted =
        float(plan.resources.size() + 2) * ImGui::GetTextLineHeightWithSpacing() + ImGui::GetStyle().ScrollbarSize;
    draw_table(context, std::clamp(ImGui::GetContentRegionAvail().y - below, line * 3, std::max(wanted, line * 3)));
    if (!buffer && !texture) {
        show_text("click one to look at it", k_dim_colour);
        return;
    }
    const PlanResource& shown = buffer ? *buffer : *texture;
    show_text(shown.name());
    ImGui::SameLine();
    show_text(resource_text(shown), k_dim_colour);
    if (buffer)
        draw_buffer_table(context, *buffer);
    else
        draw_viewer_settings(context, *texture);
}

} // namespace bounce
