#include "app/ui/discard_prompt.h"

#include "app/ui/marks.h"
#include "app/ui/open.h"
#include "app/ui/shot_writer.h"
#include "app/ui/widget_rects.h"

#include <imgui.h>

namespace bounce {

void draw_discard_prompt(PanelContext& context) {
    static constexpr const char* k_title = "Read the shot again?";
    static bool asking = false;
    std::string& edits = context.ui.window.discarding;
    if (!edits.empty() && !asking) ImGui::OpenPopup(k_title);
    asking = asking || !edits.empty();
    if (!asking) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.4f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(k_title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove)) {
        edits.clear(); // Escape closed it
        asking = false;
        return;
    }
    show_text("Your edits of " + context.session.shot().name + " are not saved: " + edits + ".");
    const std::string lost = unsaved_edits(context.session, context.ui.window.opened);
    if (!lost.empty()) show_text("They cannot all be saved: " + lost + ".", k_warning_colour);
    const bool save = ImGui::Button("save as a shot, then read again");
    note_widget("discard.save");
    ImGui::SameLine();
    const bool enter = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    const bool discard = ImGui::Button("throw away (Enter)") || enter;
    note_widget("discard.yes");
    ImGui::SameLine();
    const bool keep = ImGui::Button("keep (Escape)");
    note_widget("discard.no");
    if (save || discard || keep) {
        ImGui::CloseCurrentPopup();
        edits.clear();
        asking = false;
    }
    ImGui::EndPopup();
    if (discard) read_shot_again(context);
    if (!save) return;
    context.ui.window.ask([context]() mutable {
        save_shot(context); // where that fails the edits stay
        read_shot_again(context);
    });
}

} // namespace bounce
