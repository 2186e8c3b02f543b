#include "scene/gltf_file.h"

#include "core/error.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/limits.h"

#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t k_magic = 0x46546C67;      // "glTF"
constexpr uint32_t k_json_chunk = 0x4E4F534A; // "JSON"
constexpr uint32_t k_binary_chunk = 0x004E4942;

uint32_t read_u32(std::string_view bytes, size_t offset) {
    uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

struct Chunk {
    uint32_t type;
    std::string_view data;
};

/// Every chunk lies inside the file, or this throws.
std::vector<Chunk> split_chunks(std::string_view bytes, const std::string& where, std::vector<std::string>& notes) {
    if (bytes.size() < 12) throw Error(where + ": a .glb of fewer than 12 bytes has no header");
    if (uint32_t version = read_u32(bytes, 4); version != 2)
        throw Error(fmt::format("{}: .glb version {}; only version 2 can be read", where, version));
    size_t length = read_u32(bytes, 8);
    if (length > bytes.size())
        throw Error(
            fmt::format("{}: truncated: the header says {} bytes, the file has {}", where, length, bytes.size()));
    if (length < 12) throw Error(fmt::format("{}: the header says {} bytes, which is less than itself", where, length));
    if (length < bytes.size())
        notes.push_back(fmt::format("{} bytes after the end of the .glb", bytes.size() - length));

    std::vector<Chunk> chunks;
    for (size_t at = 12; at < length;) {
        if (length - at < 8) throw Error(fmt::format("{}: truncated chunk header at byte {}", where, at));
        size_t size = read_u32(bytes, at);
        if (size > length - at - 8)
            throw Error(
                fmt::format("{}: chunk at byte {} says {} bytes, but {} are left", where, at, size, length - at - 8));
        chunks.push_back({read_u32(bytes, at + 4), bytes.substr(at + 8, size)});
        at += 8 + size;
    }
    return chunks;
}

} // namespace

GltfFile read_gltf_file(const fs::path& path) {
    std::string where = path.string();
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw Error(where + ": no such file");
    if (const std::string kind = irregular_kind(path); !kind.empty())
        throw Error(where + ": it is " + kind + "; expected a .gltf or .glb file");

    GltfFile file;
    file.path = path;
    std::string bytes = read_file(path, k_max_scene_bytes);
    bool glb = bytes.size() >= 4 && read_u32(bytes, 0) == k_magic;
    if (!glb && path.extension() == ".glb") throw Error(where + ": not a .glb (it does not begin with 'glTF')");
    if (bytes.empty()) throw Error(where + ": the file is empty");

    std::string_view text = bytes;
    if (glb) {
        std::vector<Chunk> chunks = split_chunks(bytes, where, file.notes);
        if (chunks.empty() || chunks[0].type != k_json_chunk)
            throw Error(where + ": the first chunk of a .glb must be its JSON");
        text = chunks[0].data;
        if (chunks.size() > 1 && chunks[1].type == k_binary_chunk) file.binary = std::string(chunks[1].data);
        size_t known = file.binary ? 2 : 1;
        if (chunks.size() > known) file.notes.push_back(fmt::format("{} further .glb chunks", chunks.size() - known));
    }
    file.json = parse_json(text, where, JsonComments::refused, k_max_scene_text);
    if (!file.json.is_object())
        throw Error(where + ": a glTF file holds one JSON object, but this is " + json_kind(file.json));
    return file;
}

} // namespace bounce
