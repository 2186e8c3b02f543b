#pragma once
// The one way JSON text is read, whatever the file is: a bounded depth (so nothing that walks the tree recursively can
// overflow the stack), size and number of values (so a small file takes no gigabytes), and one message that names the
// file and the line.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace bounce {

constexpr int k_max_json_depth = 64;
/// A value takes up to some hundred bytes in memory, of which text may have but two.
constexpr size_t k_max_json_values = 2'000'000;
constexpr size_t k_max_json_text = size_t(64) << 20; ///< bytes; a .gltf may be as long as scenes may be
constexpr size_t k_max_scene_text = size_t(2) << 30;

enum class JsonComments { refused, allowed };

/// Throws Error ("`what`:3: not valid JSON: …"). `Json` is nlohmann::json, or nlohmann::ordered_json, which keeps the
/// order of the file. Comments are // and /* */. Where they are allowed (in files of ours), a key that an object has
/// twice is an error, since one of its two values would be lost, and so is a zero byte.
template <class Json = nlohmann::json>
Json parse_json(std::string_view text, const std::string& what, JsonComments comments = JsonComments::refused,
                size_t max_bytes = k_max_json_text);
extern template nlohmann::json parse_json(std::string_view, const std::string&, JsonComments, size_t);
extern template nlohmann::ordered_json parse_json(std::string_view, const std::string&, JsonComments, size_t);

/// The same of a file of ours, in which comments are allowed.
template <class Json = nlohmann::json>
Json read_json_file(const std::filesystem::path& path);
extern template nlohmann::json read_json_file(const std::filesystem::path&);
extern template nlohmann::ordered_json read_json_file(const std::filesystem::path&);

/// The library's words without its tag, and short where it quotes what it read.
std::string json_problem(const nlohmann::json::exception& error);

/// As nlohmann's dump, but text that is no UTF-8 (the name of a file may be none) is written with U+FFFD in its place
/// rather than thrown on.
template <class Json>
std::string json_dump(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// "a number", "an array of 3" …: for messages of the form "must be a number, but is …".
std::string json_kind(const nlohmann::json& value);

} // namespace bounce
