#pragma once
// JSON text → nlohmann::json, safely: nested at most `k_max_json_depth` deep (so nothing that walks the tree
// recursively can overflow the stack), and with messages that name the file and the line.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace bounce {

constexpr int k_max_json_depth = 64;

/// Throws Error ("`what`: line 3, column 7: …"). `comments` allows // and /* */.
nlohmann::json parse_json(std::string_view text, const std::string& what, bool comments = false);

/// "a number", "an array of 3" …: for messages of the form "must be a number, but is …".
std::string json_kind(const nlohmann::json& value);

} // namespace bounce
