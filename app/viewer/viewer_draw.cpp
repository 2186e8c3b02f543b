// The panels in their places.
#include "app/panels/panel.h"
#include "app/panels/parameter_edit.h"
#include "app/ui/discard_prompt.h"
#include "app/ui/edit.h"
#include "app/ui/imgui_stack.h"
#include "app/ui/light_banner.h"
#include "app/ui/open_dialog.h"
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
    TabPlace home; ///< until a person moves it
};

const std::vector<Tab> k_tabs = {{"Scene", draw_scene_panel, TabPlace::left},
                                 {"Camera", draw_camera_panel, TabPlace::left},
                                 {"Compare", draw_compare_panel, TabPlace::left},
                                 {"Capture", draw_capture_panel, TabPlace::left},
                                 {"Snapshots", draw_snapshots_panel, TabPlace::left},
                                 {"Graph", draw_graph_panel, TabPlace::upper},
                                 {"Resources", draw_resources_panel, TabPlace::upper},
                                 {"Shaders", draw_shaders_panel, TabPlace::upper},
                                 {"Parameters", draw_parameters_panel, TabPlace::lower},
                                 {"Pixel", draw_inspector_panel, TabPlace::lower},
                                 {"Cones", draw_cones_panel, TabPlace::lower},
                                 {"Stability", draw_stability_panel, TabPlace::lower},
                                 {"Nodes", draw_nodes_panel, TabPlace::bottom},
                                 {"Over time", draw_time_panel, TabPlace::bottom},
                                 {"Log", draw_log_panel, TabPlace::bottom}};

TabPlace place_of(const Tab& tab, const WindowState& window) {
    const auto moved = window.tab_places.find(tab.name);
    return moved == window.tab_places.end() ? tab.home : moved->second;
}

/// The menu of a tab, by which it goes elsewhere.
void draw_tab_menu(const Tab& tab, WindowState& window) {
    if (!ImGui::BeginPopupContextItem(tab.name)) return;
    const TabPlace place = place_of(tab, window);
    for (int i = 0; i < int(k_tab_places.size()); ++i) {
        const std::string text = fmt::format("Move to {}", k_tab_place_titles[size_t(i)]);
        if (ImGui::MenuItem(text.c_str(), nullptr, false, place != TabPlace(i))) {
            window.tab_places[tab.name] = TabPlace(i);
            if (TabPlace(i) == tab.home) window.tab_places.erase(tab.name);
            if (TabPlace(i) == TabPlace::bottom) window.layout.show_bottom = true;
            window.select_tab = tab.name;
        }
        note_widget(fmt::format("tab.{}.to_{}", tab.name, k_tab_places[size_t(i)]));
    }
    ImGui::EndPopup();
}

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
void draw_tabs(TabPlace place, const Area& area, std::string& shown, bool first, PanelContext& context) {
    if (!area.visible()) return;
    std::string& asked = context.ui.window.select_tab;
    begin_area(fmt::format("##{}", k_tab_places[size_t(place)]).c_str(), area);
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_NoTabListScrollingButtons)) {
        std::string front, wanted = first ? shown : "";
        const auto here = [&](const Tab& tab) { return place_of(tab, context.ui.window) == place; };
        for (const Tab& tab : k_tabs)
            if (here(tab) && asked == tab.name) wanted = asked;
        for (const Tab& tab : k_tabs) {
            if (!here(tab)) continue;
            bool select = wanted == tab.name;
            bool open = ImGui::BeginTabItem(tab.name, nullptr, select ? ImGuiTabItemFlags_SetSelected : 0);
            note_widget(std::string("tab.") + tab.name);
            draw_tab_menu(tab, context.ui.window);
            if (select && asked == tab.name) asked.clear();
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
    shown = shown || (is_slow() && !window_->has_input());
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
        draw_discard_prompt(panels);
        draw_open_dialog(panels);
        // What was typed into a row that is not drawn any more (another tab, a filter) was left, too.
        if (!ui_.edit.name.empty() && !ImGui::IsAnyItemActive() && !ui_.mid_frame) finish_edit(panels);
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
    draw_tabs(TabPlace::left, areas.left, ui_.window.left_tab, first, panels);
    draw_tabs(TabPlace::upper, areas.upper_right, ui_.window.upper_tab, first, panels);
    draw_tabs(TabPlace::lower, areas.lower_right, ui_.window.lower_tab, first, panels);
    draw_tabs(TabPlace::bottom, areas.bottom, ui_.window.bottom_tab, first_below, panels);
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
