// Snapshots: taken, looked at in turn or side by side, told apart, written as a page.
#include "app/panels/panel.h"
#include "app/ui/captures.h"
#include "app/ui/keys.h"
#include "app/ui/marks.h"
#include "app/ui/snapshots.h"
#include "app/ui/widget_rects.h"
#include "core/image.h"
#include "core/text.h"

#include <fmt/format.h>

namespace bounce {

namespace {

void draw_rows(PanelContext& context, Snapshots& snapshots) {
    if (!ImGui::BeginTable("all", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("left", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("right", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("snapshot");
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableHeadersRow();
    int remove = -1;
    for (int i = -1; i < int(snapshots.all.size()); ++i) {
        ImGui::PushID(i);
        ImGui::TableNextRow();
        for (int* side : {&snapshots.left, &snapshots.right}) {
            ImGui::TableNextColumn();
            const bool left = side == &snapshots.left;
            ImGui::RadioButton(left ? "##left" : "##right", side, i);
            note_widget(fmt::format("snapshots.{}.{}", left ? "left" : "right", i));
        }
        ImGui::TableNextColumn();
        if (i < 0) {
            show_text("the picture now");
        } else {
            const Snapshot& snapshot = snapshots.all[size_t(i)];
            show_text(snapshot.name);
            std::string figures = fmt::format("{:.2f} ms{}, {}", snapshot.ms, snapshot.ms_current ? "" : " (old)",
                                              format_bytes(double(snapshot.bytes)));
            for (const auto& [title, text] : snapshot.figures)
                figures += fmt::format("\n{} {}", title, text);
            show_tooltip(figures + (snapshot.command.empty() ? "" : "\n" + snapshot.command));
            show_text(figures.substr(0, figures.find('\n')), k_dim_colour);
            ImGui::TableNextColumn();
            if (ImGui::SmallButton("×")) remove = i;
            note_widget(fmt::format("snapshots.remove.{}", i));
        }
        ImGui::PopID();
    }
    ImGui::EndTable();
    if (remove >= 0) snapshots.remove(remove);
    if (remove >= 0) context.ui.redraw();
}

void draw_view(PanelContext& context, Snapshots& snapshots) {
    static constexpr const char* k_names[] = {"off", "left", "wipe", "flicker"};
    int view = int(snapshots.view);
    for (int i = 0; i < 4; ++i) {
        if (i) ImGui::SameLine();
        if (ImGui::RadioButton(k_names[i], &view, i)) context.ui.redraw();
        note_widget(std::string("snapshots.view.") + k_names[i]);
    }
    snapshots.view = SnapshotView(view);
    if (snapshots.view == SnapshotView::flicker) context.ui.redraw_panels = true;
    if (snapshots.view != SnapshotView::wipe) return;
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderFloat("##wipe", &snapshots.wipe, 0, 1, "left of %.2f");
    note_widget("snapshots.wipe");
}

/// The side that is the picture now is taken as it is at this moment.
void draw_difference(const Snapshots& snapshots) {
    if (snapshots.left < 0 || snapshots.right < 0) {
        show_wrapped("Choose two snapshots to see what was set otherwise.", k_dim_colour);
        return;
    }
    static std::string key, text; // found once for a pair
    const Snapshot &a = snapshots.all[size_t(snapshots.left)], &b = snapshots.all[size_t(snapshots.right)];
    if (key != a.name + "\n" + b.name) {
        key = a.name + "\n" + b.name;
        text = snapshot_difference(a, b);
    }
    show_text(a.name + " → " + b.name, k_dim_colour);
    ImGui::SameLine();
    if (ImGui::SmallButton("copy")) ImGui::SetClipboardText(text.c_str());
    note_widget("snapshots.copy");
    ImGui::PushFont(fixed_font());
    show_text(text.empty() ? "the same settings" : text);
    ImGui::PopFont();
}

} // namespace

void draw_snapshots_panel(PanelContext& context) {
    if (ImGui::Button("take a snapshot")) take_snapshot(context);
    note_widget("snapshots.take");
    show_tooltip("Freezes the picture, its settings and figures. Key: " + chord_of(KeyCommand::snapshot));
    if (!context.ui.snapshots || context.ui.snapshots->all.empty()) return;
    Snapshots& snapshots = *context.ui.snapshots;
    ImGui::SameLine();
    if (ImGui::Button("write a page")) {
        const auto path = new_file(context.ui.window.capture.folder, "snapshots", ".html");
        write_file_atomically(path, snapshots_page(snapshots));
        context.ui.window.capture.last = std::filesystem::absolute(path).lexically_normal().string();
        context.ui.say("saved " + path.lexically_normal().string());
    }
    note_widget("snapshots.page");
    show_tooltip("One HTML file with pictures, figures and differences, in the capture folder.");
    draw_rows(context, snapshots);
    draw_view(context, snapshots);
    ImGui::Separator();
    ImGui::BeginChild("difference", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    draw_difference(snapshots);
    ImGui::EndChild();
}

} // namespace bounce
