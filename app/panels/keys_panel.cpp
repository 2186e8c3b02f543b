// The keys, from the table that they act by.
#include "app/panels/panel.h"
#include "app/ui/keys.h"
#include "app/ui/style.h"
#include "core/text.h"

namespace bounce {

static std::string chords_text(const KeyBinding& binding) {
    if (binding.chords.size() > 4) return binding.chords.front() + " … " + binding.chords.back();
    return join(binding.chords, "  or  ");
}

void draw_keys_panel(PanelContext&) {
    // Two columns of groups, so that it fits a laptop's screen.
    const char* group = "";
    if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
    for (const KeyBinding& binding : key_bindings()) {
        if (std::string_view(group) != binding.group) {
            group = binding.group;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            if (binding.group != std::string_view(key_bindings().front().group)) ImGui::Spacing();
            ImGui::TextColored(k_accent_colour, "%s", group);
        }
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(chords_text(binding).c_str());
        ImGui::TableNextColumn();
        ImGui::TextColored(k_dim_colour, "%s", binding.what);
    }
    ImGui::EndTable();
}

} // namespace bounce
