// The keys, from the table that they act by.
#include "app/panels/panel.h"
#include "app/ui/keys.h"
#include "app/ui/style.h"

#include <imgui.h>
#include <string_view>

namespace bounce {

/// Spellings of the same keys on other keyboards are left out.
static std::string chords_text(const KeyBinding& binding) {
    const std::vector<std::string>& chords = binding.chords;
    if (chords.size() > 4) return chords.front() + " … " + chords.back();
    return chords.size() == 2 ? chords[0] + "  or  " + chords[1] : chords[0];
}

static void draw_groups(const char* table, std::string_view from, std::string_view to) {
    if (!ImGui::BeginTable(table, 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX)) return;
    std::string_view group;
    bool inside = false;
    for (const KeyBinding& binding : key_bindings()) {
        bool starts = group != binding.group;
        group = binding.group;
        inside = inside || group == from;
        if (group == to) break;
        if (!inside) continue;
        if (starts) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            if (group != from) ImGui::Spacing();
            ImGui::TextColored(k_accent_colour, "%s", binding.group);
        }
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(chords_text(binding).c_str());
        ImGui::TableNextColumn();
        ImGui::TextColored(k_dim_colour, "%s", binding.what);
    }
    ImGui::EndTable();
}

void draw_keys_panel(PanelContext&) {
    // Two columns, so that it fits a laptop's screen.
    draw_groups("left", "Camera", "Files");
    ImGui::SameLine(0, 2 * ImGui::GetFontSize());
    draw_groups("right", "Files", "");
}

} // namespace bounce
