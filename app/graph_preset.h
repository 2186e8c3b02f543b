#pragma once
// A session's values as a graph file.

#include "app/session.h"
#include "graph/graph_overlay.h"

#include <filesystem>

namespace bounce {

/// What a preset at `path` holds: a graph that extends the loaded one by the session's values and switches that differ
/// from it, with these words about it ("": that they were set in the window). Where `path` is the loaded graph's own
/// file, that file with these values in it; its comments and its layout stay. Throws Error when the loaded graph starts
/// from `path`, or is not in its file any more.
std::string graph_preset_text(const Session& session, const std::filesystem::path& path, const std::string& about = "");

/// The session's graph as one that extends nothing, with its present values and switches. Throws Error when it is not
/// in its file any more.
OrderedJson graph_as_set(const Session& session);

/// Where a preset of that name goes: assets/graphs/NAME.json, or the path when it is one. Throws Error for a bad name.
std::filesystem::path graph_preset_path(const std::string& name);

/// Throws Error when the file is there and `overwrite` is not set, and when it cannot be written.
std::filesystem::path save_graph_preset(const Session& session, const std::string& name, bool overwrite);

} // namespace bounce
