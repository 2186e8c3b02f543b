#include "app/viewer/palette.h"

#include "app/debug_views.h"
#include "app/panels/parameter_edit.h"
#include "app/ui/keys.h"
#include "app/ui/marks.h"
#include "app/ui/open.h"
#include "app/ui/texture_view.h"
#include "app/ui/views_menu.h"
#include "app/ui/widget_rects.h"
#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <imgui_stdlib.h>

namespace bounce {

static std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::vector<PaletteEntry> palette_entries(const PanelContext& context,
                                          const std::function<void(const std::string& chord)>& press) {
    std::vector<PaletteEntry> entries;
    UiState& ui = context.ui;
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.command == KeyCommand::none || binding.command == KeyCommand::bookmark) continue;
        if (binding.command == KeyCommand::palette) continue;
        const std::string chord = binding.chords.front();
        entries.push_back({"action", binding.what, chord, [press, chord] { press(chord); }});
    }
    for (const std::string& name : asset_names("shots"))
        entries.push_back(
            {"shot", name, "", [context = PanelContext(context), name]() mutable { ask_for_shot(context, name); }});
    for (const std::string& name : asset_names("graphs"))
        entries.push_back(
            {"graph", name, "", [context = PanelContext(context), name]() mutable { ask_for_graph(context, name); }});
    for (const NamedParameter& named : all_parameters(context.session.graph().model())) {
        const Parameter& parameter = *named.parameter;
        entries.push_back({"parameter", named.name(),
                           to_text(parameter.info, parameter.value) + "  " + parameter.info.help,
                           [&ui, name = named.name()] {
                               ui.window.layout.show_right = true;
                               ui.window.select_tab = "Parameters";
                               ui.only_changed_parameters = false;
                               ui.parameter_filter = name;
                           }});
    }
    for (const DebugView& view :
         debug_views(context.session.graph().model(), context.session.facts(), context.session.size()))
        entries.push_back({"view", view.name, view.about, [context = PanelContext(context), view]() mutable {
                               ask_for_view(context, view.resource, view.pass);
                           }});
    for (const PlanResource& resource : context.session.graph().plan().resources) {
        if (resource.is_buffer()) continue;
        entries.push_back({"view", resource.name(), "", [&ui, &session = context.session, name = resource.name()] {
                               pin(ui, session.graph(), name);
                           }});
    }
    return entries;
}

std::vector<size_t> palette_matches(const std::vector<PaletteEntry>& entries, const std::string& text) {
    std::vector<std::string> words;
    for (const std::string& word : split(lower(text), ' '))
        if (!word.empty()) words.push_back(word);
    std::vector<size_t> matches;
    for (size_t i = 0; i < entries.size(); ++i) {
        const std::string all = lower(entries[i].kind + " " + entries[i].name + " " + entries[i].hint);
        if (std::all_of(words.begin(), words.end(), [&](auto& word) { return all.find(word) != std::string::npos; }))
            matches.push_back(i);
    }
    if (words.empty()) return matches;
    std::stable_partition(matches.begin(), matches.end(),
                          [&](size_t i) { return lower(entries[i].name).starts_with(words.front()); });
    return matches;
}

void Palette::open(std::vector<PaletteEntry> entries) {
    entries_ = std::move(entries);
    text_.clear();
    chosen_ = 0;
    open_ = fresh_ = true;
}

void Palette::draw(PanelContext& context) {
    if (!open_) return;
    constexpr size_t k_shown = 14;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float width = std::min(ImGui::GetFontSize() * 42, display.x * 0.9f);
    ImGui::SetNextWindowPos({0.5f * (display.x - width), 0.12f * display.y});
    ImGui::SetNextWindowSize({width, 0});
    if (fresh_) ImGui::SetNextWindowFocus();
    ImGui::Begin("##palette", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
    if (fresh_) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool enter = ImGui::InputTextWithHint("##text", "an action, shot, graph, parameter or view", &text_,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
    note_widget("palette.text");
    if (ImGui::IsItemEdited()) chosen_ = 0;
    const std::vector<size_t> matches = palette_matches(entries_, text_);
    const size_t count = std::min(matches.size(), k_shown);
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow)) && chosen_ + 1 < count) ++chosen_;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow)) && chosen_ > 0) --chosen_;
    const PaletteEntry* run = nullptr;
    for (size_t i = 0; i < count; ++i) {
        const PaletteEntry& entry = entries_[matches[i]];
        ImGui::PushID(int(i));
        if (ImGui::Selectable("##row", i == chosen_)) run = &entry;
        note_widget("palette.row." + entry.name);
        ImGui::SameLine(0, 0);
        show_text(entry.kind, k_dim_colour);
        ImGui::SameLine(ImGui::GetFontSize() * 5.5f);
        show_text(entry.name);
        ImGui::SameLine();
        show_text(entry.hint, k_dim_colour);
        ImGui::PopID();
    }
    if (matches.size() > count) show_text("… " + std::to_string(matches.size() - count) + " more", k_dim_colour);
    if (matches.empty()) show_text("nothing is named so", k_dim_colour);
    if (enter && chosen_ < count) run = &entries_[matches[chosen_]];
    const bool left = !fresh_ && !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
    if (run) context.ui.window.ask(run->run);
    if (run || enter || left || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) open_ = false;
    fresh_ = false;
    ImGui::End();
}

} // namespace bounce
