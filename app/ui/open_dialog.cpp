#include "app/ui/open_dialog.h"

#include "app/ui/marks.h"
#include "app/ui/open.h"
#include "app/ui/widget_rects.h"
#include "scene/scene_formats.h"

#include <algorithm>
#include <cctype>
#include <imgui_stdlib.h>

namespace bounce {

namespace fs = std::filesystem;

namespace {

struct Dialog {
    bool open = false, begun = false;
    fs::path folder, listed; ///< `listed`: of which `entries` are
    std::vector<FolderEntry> entries;
    std::string filter;
};

Dialog& dialog() {
    static Dialog one;
    return one;
}

bool can_be_opened(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".json" || extension == ".hdr" || scene_format_of(path);
}

bool contains(const std::string& text, const std::string& part) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

/// Returns the file that was chosen.
fs::path draw_entries(Dialog& state) {
    fs::path chosen;
    if (state.folder.has_parent_path() && state.folder != state.folder.root_path()) {
        if (ImGui::Selectable("../", false, ImGuiSelectableFlags_DontClosePopups))
            state.folder = state.folder.parent_path();
        note_widget("open.parent");
    }
    for (const FolderEntry& entry : state.entries) {
        if (!contains(entry.name, state.filter)) continue;
        if (ImGui::Selectable(entry.name.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) {
            if (entry.is_folder)
                state.folder = entry.path, state.filter.clear();
            else
                chosen = entry.path;
        }
        note_widget("open.entry." + entry.name);
    }
    if (state.entries.empty()) show_text("nothing here that can be opened", k_dim_colour);
    return chosen;
}

fs::path draw_recent(const WindowState& window) {
    fs::path chosen;
    if (window.recent_files.empty()) show_text("no file was opened yet", k_dim_colour);
    for (size_t i = 0; i < window.recent_files.size(); ++i) {
        const fs::path path = window.recent_files[i];
        ImGui::PushID(int(i));
        if (ImGui::Selectable(path.filename().c_str(), false, ImGuiSelectableFlags_DontClosePopups)) chosen = path;
        note_widget("open.recent." + path.filename().string());
        show_tooltip(path.string());
        ImGui::PopID();
    }
    return chosen;
}

} // namespace

void note_recent_file(WindowState& window, const std::string& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return;
    const std::string whole = fs::absolute(path).lexically_normal().string();
    auto& recent = window.recent_files;
    std::erase(recent, whole);
    recent.insert(recent.begin(), whole);
    if (recent.size() > k_recent_files) recent.resize(k_recent_files);
}

std::vector<FolderEntry> openable_entries(const fs::path& folder) {
    std::vector<FolderEntry> entries;
    std::error_code error;
    for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
         !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::error_code ignored;
        const bool is_folder = it->is_directory(ignored);
        if (name.starts_with(".") || (!is_folder && !(it->is_regular_file(ignored) && can_be_opened(it->path()))))
            continue;
        entries.push_back({is_folder ? name + "/" : name, it->path(), is_folder});
    }
    std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
        return std::pair(!a.is_folder, a.name) < std::pair(!b.is_folder, b.name);
    });
    return entries;
}

void ask_for_open_dialog(PanelContext& context) {
    Dialog& state = dialog();
    state.open = true;
    state.begun = false;
    state.listed.clear();
    state.filter.clear();
    if (state.folder.empty()) state.folder = fs::absolute(context.session.shot().path).lexically_normal().parent_path();
}

void draw_open_dialog(PanelContext& context) {
    static constexpr const char* k_title = "Open a file";
    Dialog& state = dialog();
    if (!state.open) return;
    if (!state.begun) ImGui::OpenPopup(k_title);
    state.begun = true;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({0.6f * display.x, 0.7f * display.y});
    if (!ImGui::BeginPopupModal(k_title, nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
        state.open = false; // Escape closed it
        return;
    }
    if (state.listed != state.folder) {
        state.entries = openable_entries(state.folder);
        state.listed = state.folder;
    }
    show_text(state.folder.string(), k_dim_colour);
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6);
    ImGui::InputTextWithHint("##filter", "part of a name", &state.filter);
    note_widget("open.filter");
    ImGui::SameLine();
    const bool cancel = ImGui::Button("cancel", {-1, 0});
    note_widget("open.cancel");
    const float half = 0.62f * ImGui::GetContentRegionAvail().x;
    ImGui::BeginChild("entries", {half, 0}, true);
    fs::path chosen = draw_entries(state);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("recent", {0, 0}, true);
    show_text("opened last", k_dim_colour);
    if (const fs::path recent = draw_recent(context.ui.window); !recent.empty()) chosen = recent;
    ImGui::EndChild();
    if (cancel || !chosen.empty()) {
        ImGui::CloseCurrentPopup();
        state.open = false;
    }
    ImGui::EndPopup();
    if (!chosen.empty()) ask_for_file(context, chosen.string());
}

} // namespace bounce
