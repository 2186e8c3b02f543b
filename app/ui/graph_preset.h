#pragma once
// The panel's values as a graph file.

#include "app/session.h"

#include <filesystem>

namespace bounce {

/// The loaded graph's file with the values and switches of the panels in the places of its own. Throws Error when the
/// file is not the one that was loaded any more.
std::string graph_preset_text(const Session& session);

/// Where a preset of that name goes: assets/graphs/NAME.json, or the path when it is one. Throws Error for a bad name.
std::filesystem::path graph_preset_path(const std::string& name);

/// Throws Error when the file is there and `overwrite` is not set, and when it cannot be written.
std::filesystem::path save_graph_preset(const Session& session, const std::string& name, bool overwrite);

} // namespace bounce
