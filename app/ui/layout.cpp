#include "app/ui/layout.h"

#include <algorithm>
#include <cmath>
#include <imgui_internal.h>

namespace bounce {

static constexpr float k_gap = 4; // between areas, and the width of the splitters

Areas arrange(const LayoutState& layout, ImVec2 display, float scale) {
    Areas areas;
    float gap = std::round(k_gap * scale);
    float status = std::round(26 * scale);
    float height = std::max(display.y - status, 1.0f);
    float left = layout.show_left ? std::round(layout.left * scale) : 0;
    float right = layout.show_right ? std::round(layout.right * scale) : 0;
    // On a narrow window both columns give way alike.
    float most = display.x * 0.67f - 2 * gap;
    if (left + right > most) {
        float share = std::max(most, 2.0f) / (left + right);
        left = std::floor(left * share);
        right = std::floor(right * share);
    }
    float x0 = left > 0 ? left + gap : 0;
    float x1 = right > 0 ? display.x - right - gap : display.x;
    float bottom = layout.show_bottom ? std::min(std::round(layout.bottom_height * scale), height * 0.75f) : 0;
    areas.left = {{0, 0}, {left, height}};
    areas.viewport = {{x0, 0}, {std::max(x1 - x0, 1.0f), std::max(height - (bottom > 0 ? bottom + gap : 0), 1.0f)}};
    if (bottom > 0) areas.bottom = {{x0, height - bottom}, {x1 - x0, bottom}};
    float upper = std::round(height * std::clamp(layout.right_split, 0.1f, 0.9f));
    areas.upper_right = {{display.x - right, 0}, {right, upper}};
    areas.lower_right = {{display.x - right, upper + gap}, {right, std::max(height - upper - gap, 1.0f)}};
    areas.status = {{0, height}, {display.x, status}};
    for (Area* area : {&areas.left, &areas.upper_right, &areas.lower_right, &areas.viewport, &areas.bottom})
        if (layout.swapped) area->min.x = display.x - area->min.x - area->size.x;
    return areas;
}

/// A bar that can be dragged; returns how far, along its short side.
static float splitter(const char* name, ImVec2 min, ImVec2 size, bool vertical, bool& dragged) {
    ImGui::SetCursorScreenPos(min);
    ImGui::InvisibleButton(name, {std::max(size.x, 1.0f), std::max(size.y, 1.0f)});
    bool active = ImGui::IsItemActive();
    if (active || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImU32 colour = ImGui::GetColorU32(active ? ImGuiCol_SeparatorActive : ImGuiCol_SeparatorHovered);
        ImGui::GetWindowDrawList()->AddRectFilled(min, {min.x + size.x, min.y + size.y}, colour);
    }
    dragged = dragged || active;
    if (!active) return 0;
    return vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
}

bool drag_splitters(LayoutState& layout, const Areas& areas, float scale) {
    ImVec2 display = ImGui::GetIO().DisplaySize;
    bool dragged = false;
    float gap = std::round(k_gap * scale);
    // A window behind all others: what the areas leave free are the bars.
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(display);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.085f, 0.085f, 0.085f, 1));
    ImGui::Begin("##background", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    auto limit = [&](float value) { return std::clamp(value, 150.0f, std::max(display.x / scale * 0.5f, 150.0f)); };
    // The bar beside a column, on the side of the picture; a column grows as its bar moves away from it.
    const auto inner = [&](const Area& column, bool is_left) {
        return is_left != layout.swapped ? column.min.x + column.size.x : column.min.x - gap;
    };
    const float outward = layout.swapped ? -1.0f : 1.0f;
    if (areas.left.visible()) {
        float moved = splitter("left", {inner(areas.left, true), 0}, {gap, areas.left.size.y}, true, dragged);
        if (moved != 0) layout.left = limit((areas.left.size.x + outward * moved) / scale);
    }
    if (areas.upper_right.visible()) {
        float height = areas.lower_right.min.y + areas.lower_right.size.y;
        float moved = splitter("right", {inner(areas.upper_right, false), 0}, {gap, height}, true, dragged);
        if (moved != 0) layout.right = limit((areas.upper_right.size.x - outward * moved) / scale);
        moved = splitter("split", {areas.upper_right.min.x, areas.upper_right.size.y}, {areas.upper_right.size.x, gap},
                         false, dragged);
        if (moved != 0) layout.right_split = std::clamp((areas.upper_right.size.y + moved) / height, 0.1f, 0.9f);
    }
    if (areas.bottom.visible()) {
        float moved = splitter("bottom", {areas.bottom.min.x, areas.bottom.min.y - gap}, {areas.bottom.size.x, gap},
                               false, dragged);
        if (moved != 0) layout.bottom_height = std::clamp((areas.bottom.size.y - moved) / scale, 60.0f, 2000.0f);
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    return dragged;
}

void keep_over_picture() {
    ImGuiWindow* own = ImGui::GetCurrentWindow();
    const ImGuiWindow* picture = ImGui::FindWindowByName(k_picture_window);
    const ImVector<ImGuiWindow*>& order = GImGui->Windows; // the last one is in front
    if (picture && order.find(own) < std::find(order.begin(), order.end(), picture))
        ImGui::BringWindowToDisplayFront(own);
}

bool begin_area(const char* name, const Area& area, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos(area.min);
    ImGui::SetNextWindowSize(area.size);
    return ImGui::Begin(name, nullptr,
                        ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                            ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | flags);
}

} // namespace bounce
