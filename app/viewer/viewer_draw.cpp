// The panels in their places.
#include "app/panels/panel.h"
#include "app/panels/parameter_edit.h"
#include "app/ui/edit.h"
#include "app/ui/imgui_stack.h"
#include "app/ui/light_banner.h"
#include "app/ui/status_bar.h"
#include "app/ui/style.h"
#include "app/ui/timeline.h"
#include "app/ui/viewed.h"
#include "app/ui/views_menu.h"
#include "app/ui/widget_rects.h"
#include "app/viewer/viewer_app.h"
#include "core/problem.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui_internal.h>

namespace bounce {

namespace {

struct Tab {
    const char* name;
    void (*draw)(PanelContext&);
};

const std::vector<Tab> k_left = {{"Scene", draw_scene_panel},
                                 {"Camera", draw_camera_panel},
                                 {"Compare", draw_compare_panel},
                                 {"Capture", draw_capture_panel},
                                 {"Snapshots", draw_snapshots_panel}};
const std::vector<Tab> k_upper = {
    {"Graph", draw_graph_panel}, {"Resources", draw_resources_panel}, {"Shaders", draw_shaders_panel}};
const std::vector<Tab> k_lower = {{"Parameters", draw_parameters_panel},
                                  {"Pixel", draw_inspector_panel},
                                  {"Cones", draw_cones_panel},
                                  {"Stability", draw_stability_panel}};

const std::vector<Tab> k_bottom = {
    {"Nodes", draw_nodes_panel}, {"Over time", draw_time_panel}, {"Log", draw_log_panel}};

/// A panel in which something goes wrong says so, and the frame goes on.
void draw_panel(const Tab& tab, PanelContext& context) {
    ImGuiStack stack;
    try {
        tab.draw(context);
    } catch (const std::exception& problem) {
        stack.unwind();
        context.ui.say(problem_text(problem), true);
    }
}

/// `shown`: the tab in front; changed by a person, or by what asks for a tab.
void draw_tabs(const char* name, const Area& area, const std::vector<Tab>& tabs, std::string& shown, bool first,
               PanelContext& context) {
    if (!area.visible()) return;
    std::string& asked = context.ui.window.select_tab;
    begin_area(name, area);
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_NoTabListScrollingButtons)) {
        std::string front;
        for (const Tab& tab : tabs) {
            bool select = asked == tab.name || (first && shown == tab.name);
            bool open = ImGui::BeginTabItem(tab.name, nullptr, select ? ImGuiTabItemFlags_SetSelected : 0);
            note_widget(std::string("tab.") + tab.name);
            if (asked == tab.name) asked.clear();
            if (!open) continue;
            front = tab.name;
            ImGui::BeginChild("panel");
            draw_panel(tab, context);
            ImGui::EndChild();
            ImGui::EndTabItem();
        }
        // On the first frame ImGui shows the first tab before it is told which one is asked for.
        if (!first && !front.empty()) shown = front;
        ImGui::EndTabBar();
    }
    ImGui::End();
}

} // namespace

/// Escape closes what is open: a dropdown, a menu. (ImGui does that only where keys move its focus, too.)
void ViewerApp::take_keys() {
    for (KeyPress& key : window_->take_keys()) {
        if (key.in_popup && !key.in_text && key.chord == "Escape")
            ImGui::ClosePopupToLevel(std::max(GImGui->OpenPopupStack.Size - 1, 0), true);
        keys_.push_back(std::move(key));
    }
}

void ViewerApp::draw(bool shown) {
    PanelContext panels = context();
    float scale = interface_scale();
    window_->set_title(fmt::format("{} · {} – Bounce", session_->shot().name, session_->graph().model().file().name));
    window_->begin_frame();
    take_keys();
    // A person sees the answer of the panels before a frame that takes its time.
    constexpr float k_slow_frame = 100; // milliseconds
    const bool slow = !ui_.frame_times.empty() && ui_.frame_times.back().ms > k_slow_frame;
    shown = shown || (slow && !window_->has_input());
    begin_widget_frame();
    begin_edit_frame();
    ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGuiStack stack;
    attempt([&] {
        Areas areas = arrange(ui_.window.layout, display, scale);
        if (drag_splitters(ui_.window.layout, areas, scale)) areas = arrange(ui_.window.layout, display, scale);
        draw_panels(panels, areas);
        viewport_.draw(panels, areas.viewport, *window_);
        draw_views_menu(panels, areas.viewport);
        draw_light_banner(panels, areas.viewport);
        draw_status_bar(panels, areas.status, window_->capabilities());
        draw_keys_window(panels);
        palette_.draw(panels);
        // What was typed into a row that is not drawn any more (another tab, a filter) was left, too.
        if (!ui_.edit.name.empty() && !ImGui::IsAnyItemActive()) finish_edit(panels);
        if (shown) end_widget_frame(panels);
    });
    stack.unwind(); // nothing to do unless an exception ended the above
    window_->end_frame(shown);
}

void ViewerApp::draw_panels(PanelContext& panels, const Areas& areas) {
    // Panels ask for their tab over two frames: the one that they are asked in may be drawn after it.
    static bool first = true, first_below = true;
    ui_.hovered.clear();
    viewed().wants_histogram = false;
    if (ui_.timeline) ui_.timeline->wants_change = false;
    draw_tabs("##left", areas.left, k_left, ui_.window.left_tab, first, panels);
    draw_tabs("##upper", areas.upper_right, k_upper, ui_.window.upper_tab, first, panels);
    draw_tabs("##lower", areas.lower_right, k_lower, ui_.window.lower_tab, first, panels);
    draw_tabs("##bottom", areas.bottom, k_bottom, ui_.window.bottom_tab, first_below, panels);
    first = false;
    first_below = !areas.bottom.visible();
}

void ViewerApp::draw_keys_window(PanelContext& panels) {
    if (!ui_.show_keys) return;
    ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x * 0.95f, display.y * 0.95f});
    ImGui::SetNextWindowFocus();
    if (ImGui::Begin("Keys", &ui_.show_keys,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize)) {
        draw_keys_panel(panels);
    }
    ImGui::End();
}

} // namespace bounce
