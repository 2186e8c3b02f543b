#pragma once
// The container of a glTF 2.0 asset: a .gltf text or a .glb with its chunks, and the bytes that its URIs name.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

struct GltfFile {
    std::filesystem::path path;
    nlohmann::json json;               ///< the root object
    std::optional<std::string> binary; ///< the BIN chunk of a .glb
    std::vector<std::string> notes;
};

/// Reads and splits the file; the first bytes decide whether it is a .glb. Throws Error when it cannot be read, a chunk
/// reaches outside the file, or the JSON is broken.
GltfFile read_gltf_file(const std::filesystem::path& path);

/// The bytes a URI names: a data: URI, or a regular file relative to `base` (percent escapes resolved). Throws Error
/// that begins with `what` on a missing file, one of more than `max_bytes`, an absolute path, another scheme or damaged
/// base64.
std::vector<unsigned char> read_uri(const std::string& uri, const std::filesystem::path& base, const std::string& what,
                                    uint64_t max_bytes);

bool is_data_uri(const std::string& uri);
/// The file a relative URI names: percent escapes resolved, or, where no such file is, as written. Throws as read_uri.
std::filesystem::path uri_path(const std::string& uri, const std::filesystem::path& base, const std::string& what);

/// RFC 4648 base64, padding optional. Nothing when a character does not belong or the length is impossible.
std::optional<std::vector<unsigned char>> decode_base64(std::string_view text);

} // namespace bounce
