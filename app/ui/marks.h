#pragma once
// What panels have in common: colours with a meaning, text, tooltips.

#include <imgui.h>
#include <string>

namespace bounce {

inline constexpr ImVec4 k_error_colour{1.00f, 0.42f, 0.38f, 1};
inline constexpr ImVec4 k_warning_colour{1.00f, 0.76f, 0.30f, 1};
inline constexpr ImVec4 k_good_colour{0.50f, 0.82f, 0.50f, 1};
inline constexpr ImVec4 k_dim_colour{0.58f, 0.60f, 0.64f, 1};
inline constexpr ImVec4 k_bar_colour{0.28f, 0.45f, 0.68f, 0.75f};
inline constexpr ImVec4 k_pinned_colour{0.95f, 0.76f, 0.35f, 1};

/// Text as it is: a % in a name is no format.
inline void show_text(const std::string& text) {
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
}
inline void show_text(const std::string& text, const ImVec4& colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    show_text(text);
    ImGui::PopStyleColor();
}
/// Broken at the end of the column or window.
inline void show_wrapped(const std::string& text, const ImVec4& colour) {
    ImGui::PushTextWrapPos(0);
    show_text(text, colour);
    ImGui::PopTextWrapPos();
}
/// A number's cell, flush right.
inline void show_right(const std::string& text) {
    float spare = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
    if (spare > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + spare);
    show_text(text);
}
/// Of the item before, when the pointer is over it.
inline void show_tooltip(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 34);
    show_text(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

} // namespace bounce
