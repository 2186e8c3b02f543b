#pragma once
// Files of the assets by name: assets/graphs, shots, sweeps, tables.

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

/// The names of the .json files in assets/KIND, sorted.
std::vector<std::string> asset_names(const std::string& kind);

/// `name` where it is a file, else assets/KIND/NAME.json. Throws Error naming the nearest; `what` it is: "sweep".
std::filesystem::path find_asset(const std::string& kind, const std::string& what, const std::string& name);

} // namespace bounce
