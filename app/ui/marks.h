#pragma once
// What panels of data have in common: text as it is, numbers, tooltips.

#include "app/ui/style.h"

#include <string>

namespace bounce {

inline const ImVec4 k_bar_colour{0.36f, 0.62f, 0.92f, 0.38f};
inline const ImVec4 k_pinned_colour{0.95f, 0.76f, 0.35f, 1};

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
