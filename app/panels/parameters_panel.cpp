// Every parameter of the graph, by pass.
#include "app/panels/panel.h"
#include "app/panels/parameter_edit.h"
#include "app/panels/parameter_sweep.h"
#include "app/panels/parameter_widget.h"
#include "app/ui/marks.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace bounce {

namespace {

ImVec4 origin_colour(ParameterOrigin origin) {
    switch (origin) {
    case ParameterOrigin::default_value:
        return {0.45f, 0.46f, 0.50f, 1};
    case ParameterOrigin::graph:
        return {0.38f, 0.62f, 0.95f, 1};
    case ParameterOrigin::command_line:
        return {0.55f, 0.82f, 0.45f, 1};
    case ParameterOrigin::panel:
        return {0.98f, 0.70f, 0.28f, 1};
    }
    return {};
}

/// Yours, the preset's (the graph file's), or the default.
const char* whose(ParameterOrigin origin) {
    switch (origin) {
    case ParameterOrigin::default_value:
        return "default";
    case ParameterOrigin::graph:
        return "preset: from the graph file";
    case ParameterOrigin::command_line:
        return "mine: from the command line";
    case ParameterOrigin::panel:
        return "mine: set in the window";
    }
    return "";
}

std::string help_text(const std::string& name, const std::string& type, const Parameter& p) {
    const ParameterInfo& info = p.info;
    std::string text = name + (info.help.empty() ? "" : ": " + info.help);
    std::string range = range_text(info);
    if (!range.empty()) text += "\nrange " + range + (info.unit.empty() ? "" : " " + info.unit);
    text += "\ndefault " + info.default_text();
    text += fmt::format("\nnow {}{}: {}", p.is_auto ? "auto, " : "", to_text(info, p.value), whose(p.origin));
    if (p.is_auto && !p.reason.empty()) text += "\nbecause " + p.reason;
    if (info.is_static) text += "\ncompiled in: a change compiles the shader again, when you let go";
    if (!info.is_static && !info.in_shader) text += "\nit shapes what the pass makes: it changes when you let go";
    text += "\ndeclared in " + (!info.where.empty()          ? info.where
                                : name.starts_with("graph.") ? "the graph file"
                                                             : "pass type " + type);
    return text + "\nA double click on the name resets it.";
}

/// A coloured square that tells who set the value, and opens the menu.
void draw_mark(const Parameter& parameter) {
    float side = ImGui::GetFontSize() * 0.55f, height = ImGui::GetFrameHeight();
    ImVec2 from = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("mark", ImVec2(side + 4, height))) ImGui::OpenPopup("menu");
    float y = from.y + (height - side) / 2;
    ImVec4 colour = origin_colour(parameter.origin);
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(from.x, y), ImVec2(from.x + side, y + side),
                                              ImGui::GetColorU32(colour), 2);
    show_tooltip(std::string(whose(parameter.origin)) + "\nClick to reset or to copy.");
}

void draw_menu(PanelContext& context, const std::string& name, const Parameter& parameter) {
    if (!ImGui::BeginPopup("menu")) return;
    show_text(name, k_dim_colour);
    const GraphModel& model = context.session.graph().model();
    const ParameterText home = home_of(model, name.substr(0, name.find('.')), parameter);
    const bool preset = home.origin == ParameterOrigin::graph;
    show_text(whose(parameter.origin), origin_colour(parameter.origin));
    if (ImGui::MenuItem(
            fmt::format("Reset to {}: {}###reset", preset ? "the preset" : "the default", home.text).c_str()))
        reset_parameters(context, {name});
    note_widget(name + ".reset");
    if (!parameter.info.automatic.empty() && ImGui::MenuItem("By what the scene needs (auto)", "", parameter.is_auto)) {
        const ParameterText before = text_of(name.substr(0, name.find('.')), parameter);
        const ParameterText after{name, k_auto, ParameterOrigin::panel};
        if (apply(context.session, context.ui, {after})) push_undo(context, name, {before}, {after});
    }
    note_widget(name + ".auto");
    if (ImGui::MenuItem("Copy as --set")) {
        std::string option = "--set " + name + "=" + parameter.text();
        ImGui::SetClipboardText(option.c_str());
        context.ui.say("copied: " + option);
    }
    note_widget(name + ".copy");
    if (!sweep_values(parameter.info).empty()) {
        if (ImGui::MenuItem("Sweep over its range")) ParameterSweep::start(context, name);
        note_widget(name + ".sweep");
        show_tooltip("Measures time, and error where a reference is there, at values from one end to the other.");
    }
    ImGui::EndPopup();
}

/// The widget, and the edit that it makes: one step of undo from press to release.
void draw_value(PanelContext& context, const std::string& id, const Parameter& parameter) {
    const ParameterInfo& info = parameter.info;
    ParameterText before = text_of(id, parameter);
    ParameterValue present = parameter.value;
    if (const auto waiting = context.ui.waiting_values.find(before.name); waiting != context.ui.waiting_values.end()) {
        before.text = waiting->second;
        if (before.text != k_auto) present = parse_value(info, std::string_view(before.text));
    }
    ParameterEdit& edit = context.ui.edit;
    // What is typed waits for its end; so does a drag of what has the graph planned or a shader compiled again.
    const bool shapes = shapes_plan(context.session.graph(), before.name, parameter);
    const bool held = edit.name == before.name && (shapes || edit.waits);
    ParameterValue value = held && edit.value.index() == present.index() ? edit.value : present;
    bool at_once = false;
    const bool changed = draw_parameter_widget(before.name, info, value, at_once);
    note_widget(before.name);
    const bool begun = ImGui::IsItemActivated(), ended = ImGui::IsItemDeactivated(),
               edited = ImGui::IsItemDeactivatedAfterEdit(), typing = is_typing();
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) ImGui::OpenPopup("menu");

    if (begun || (changed && edit.name != before.name)) {
        finish_edit(context); // another that was left by this one
        edit = {before.name, before.text, before.origin, value, shapes || at_once};
    }
    if (edit.name != before.name) return;
    const bool typed = typing || (edit.waits && !shapes && !at_once);
    edit.waits = edit.waits || typing;
    if (changed) edit.value = value;
    if (changed && !edit.waits)
        apply(context.session, context.ui, {{before.name, to_text(info, value), ParameterOrigin::panel}});
    if (ended && typed && typing_was_cancelled())
        edit = {};
    else if ((changed && at_once) || edited)
        finish_edit(context);
    else if (ended)
        edit = {};
}

void draw_row(PanelContext& context, const NamedParameter& named, const std::string& type) {
    std::string name = named.name();
    const Parameter& parameter = *named.parameter;
    ImGui::PushID(name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_mark(parameter);
    note_widget(name + ".mark");
    ImGui::SameLine(0, 2);
    ImGui::AlignTextToFramePadding();
    show_text(parameter.info.name);
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) ImGui::OpenPopup("menu");
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) reset_parameters(context, {name});
    note_widget(name + ".name");
    show_tooltip(help_text(name, type, parameter));
    if (!parameter.info.unit.empty()) {
        ImGui::SameLine(0, 5);
        show_text(parameter.info.unit, k_dim_colour);
    }
    ImGui::TableNextColumn();
    draw_value(context, named.id, parameter);
    if (!ImGui::IsAnyItemActive()) show_tooltip(help_text(name, type, parameter));
    draw_menu(context, name, parameter);
    ImGui::PopID();
}

bool contains(const std::string& text, const std::string& part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(), [](unsigned char a, unsigned char b) {
               return std::tolower(a) == std::tolower(b);
           }) != text.end();
}

/// What the marks mean, and how many values are whose.
void draw_legend(const std::vector<NamedParameter>& all) {
    size_t mine = 0, preset = 0;
    for (const NamedParameter& named : all) {
        mine += named.parameter->origin >= ParameterOrigin::command_line;
        preset += named.parameter->origin == ParameterOrigin::graph;
    }
    const std::pair<ParameterOrigin, std::string> entries[] = {
        {ParameterOrigin::panel, fmt::format("{} mine", mine)},
        {ParameterOrigin::graph, fmt::format("{} preset", preset)},
        {ParameterOrigin::default_value, fmt::format("{} default", all.size() - mine - preset)}};
    for (const auto& [origin, text] : entries) {
        if (origin != entries[0].first) ImGui::SameLine();
        show_text("■", origin_colour(origin));
        ImGui::SameLine(0, 3);
        show_text(text, k_dim_colour);
        show_tooltip(origin == ParameterOrigin::panel   ? "Set by you: in the window, or (green) on the command line."
                     : origin == ParameterOrigin::graph ? "Set by the graph file."
                                                        : "As it was declared.");
    }
}

void draw_tools(PanelContext& context, const std::vector<NamedParameter>& all) {
    UiState& ui = context.ui;
    char filter[96] = {};
    std::strncpy(filter, ui.parameter_filter.c_str(), sizeof filter - 1);
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6.5f);
    if (ImGui::InputTextWithHint("##filter", "filter by name or help", filter, sizeof filter))
        ui.parameter_filter = filter;
    note_widget("parameters.filter");
    ImGui::SameLine();
    ImGui::Checkbox("changed", &ui.only_changed_parameters);
    note_widget("parameters.changed");
    show_tooltip("Only parameters that are not at their default.");

    std::vector<std::string> set;
    for (const NamedParameter& named : all) {
        if (named.parameter->origin >= ParameterOrigin::command_line) set.push_back(named.name());
    }
    ImGui::BeginDisabled(set.empty());
    if (ImGui::SmallButton("reset all")) reset_parameters(context, set);
    note_widget("parameters.reset_all");
    show_tooltip(fmt::format("Puts {} parameters back to the graph's values.", set.size()));
    ImGui::EndDisabled();
    ImGui::SameLine();
    std::string options = context.session.graph().model().values().options();
    ImGui::BeginDisabled(options.empty());
    if (ImGui::SmallButton("copy all as --set")) {
        ImGui::SetClipboardText(options.c_str());
        ui.say("copied: " + options);
    }
    note_widget("parameters.copy_all");
    show_tooltip("Those that are mine.");
    ImGui::EndDisabled();
    draw_legend(all);
}

} // namespace

void draw_parameters_panel(PanelContext& context) {
    const GraphModel& model = context.session.graph().model();
    std::vector<NamedParameter> all = all_parameters(model);
    draw_tools(context, all);
    draw_sweep(context);
    const UiState& ui = context.ui;
    std::erase_if(all, [&](const NamedParameter& named) {
        const ParameterInfo& info = named.parameter->info;
        bool found = contains(named.name(), ui.parameter_filter) || contains(info.help, ui.parameter_filter);
        bool changed = named.parameter->text() != info.default_text();
        return !found || (ui.only_changed_parameters && !changed && ui.edit.name != named.name());
    });
    if (all.empty()) show_text("no parameter fits", k_dim_colour);
    ImGui::BeginChild("values"); // the tools above stay while these scroll
    for (size_t i = 0; i < all.size();) {
        const std::string id = all[i].id;
        size_t end = i;
        while (end < all.size() && all[end].id == id)
            ++end;
        const PassNode* node = model.find_node(id);
        std::string type = node ? node->entry.type : "";
        // What is looked for is shown in any case.
        std::set<std::string>& closed = context.ui.window.closed_passes;
        const bool searched = !ui.parameter_filter.empty();
        ImGui::SetNextItemOpen(searched || !closed.contains(id));
        const bool open = ImGui::CollapsingHeader(id.c_str());
        note_widget("parameters.pass." + id);
        if (ImGui::IsItemToggledOpen() && !searched) open ? void(closed.erase(id)) : void(closed.insert(id));
        if (open && ImGui::BeginTable(id.c_str(), 2, ImGuiTableFlags_SizingStretchProp)) {
            ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 5);
            ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 6);
            for (size_t p = i; p < end; ++p)
                draw_row(context, all[p], type);
            ImGui::EndTable();
        }
        i = end;
    }
    ImGui::EndChild();
}

} // namespace bounce
