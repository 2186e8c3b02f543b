#pragma once
// What files of tables have in common: where they are found, and how their JSON is read.

#include "app/experiments/sweep.h"
#include "core/error.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bounce {

/// The path, or assets/tables/NAME.json. Throws Error that names the nearest.
std::filesystem::path find_table(const std::string& name);

/// Throws Error when the file holds no JSON object.
nlohmann::ordered_json read_table(const std::filesystem::path& path);

/// Reports keys that are not in `known`.
void check_keys(const nlohmann::ordered_json& object, const std::string& where, const std::vector<std::string>& known,
                ErrorList& errors);

/// The text at `key`, or "".
std::string text_at(const nlohmann::ordered_json& object, const char* key, const std::string& where, ErrorList& errors,
                    bool required);

/// "set": {"pass.parameter": value} as --set texts; none where there is no such key.
ParameterValues sets_at(const nlohmann::ordered_json& object, const std::string& where, ErrorList& errors);

/// A value as --set takes it.
std::string set_text(const nlohmann::ordered_json& value);

/// The names of metrics in "metrics"; tells about those that there are not.
std::vector<std::string> metrics_at(const nlohmann::ordered_json& object, const std::string& where, ErrorList& errors);

} // namespace bounce
