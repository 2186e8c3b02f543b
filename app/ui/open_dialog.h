#pragma once
// Files to open by clicks: folders, what in them can be opened, and what was opened last.

#include "app/ui/panel_context.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

inline constexpr size_t k_recent_files = 12;

/// The newest first, each once. Names of shots and graphs of the assets are no files and are left out.
void note_recent_file(WindowState& window, const std::string& path);

struct FolderEntry {
    std::string name; ///< as it is shown: folders end in "/"
    std::filesystem::path path;
    bool is_folder = false;
};
/// Folders, then the scenes, shots, graphs and skies of a folder, each by name; hidden ones are left out. Empty where
/// it cannot be read.
std::vector<FolderEntry> openable_entries(const std::filesystem::path& folder);

/// Shows the dialog from the next frame on: in the folder of the present shot at first, later where it was left.
void ask_for_open_dialog(PanelContext& context);
void draw_open_dialog(PanelContext& context);

} // namespace bounce
