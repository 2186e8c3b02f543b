// What the program said, newest at the bottom.
#include "app/panels/panel.h"
#include "app/ui/style.h"
#include "core/log.h"

namespace bounce {

static ImVec4 colour_of(spdlog::level::level_enum level) {
    if (level >= spdlog::level::err) return k_error_colour;
    if (level == spdlog::level::warn) return k_warning_colour;
    if (level <= spdlog::level::debug) return k_dim_colour;
    return ImGui::GetStyleColorVec4(ImGuiCol_Text);
}

void draw_log_panel(PanelContext& context) {
    std::deque<LogLine> lines = recent_log_lines();
    if (ImGui::SmallButton("copy")) {
        std::string all;
        for (const LogLine& line : lines)
            all += line.text + "\n";
        ImGui::SetClipboardText(all.c_str());
        context.ui.say("the log is on the clipboard");
    }
    ImGui::SameLine();
    ImGui::TextColored(k_dim_colour, "%zu lines", lines.size());
    ImGui::BeginChild("lines", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::PushFont(fixed_font());
    bool at_end = ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1;
    for (const LogLine& line : lines) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour_of(line.level));
        ImGui::TextUnformatted(line.text.c_str());
        ImGui::PopStyleColor();
    }
    if (lines.empty()) ImGui::TextColored(k_dim_colour, "nothing yet");
    // Follows what comes, unless somebody scrolled up to read.
    if (at_end) ImGui::SetScrollHereY(1);
    ImGui::PopFont();
    ImGui::EndChild();
}

} // namespace bounce
