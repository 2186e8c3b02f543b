#pragma once
// Tiny glTF files for tests: a folder that is removed again, and a document whose buffer is filled piece by piece.

#include "core/error.h"
#include "core/image.h"
#include "scene/shot.h"
#include "support/shared_scene.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace bounce::testing {

using nlohmann::json;
namespace fs = std::filesystem;

class TempFolder {
  public:
    TempFolder() {
        std::string pattern = (fs::temp_directory_path() / "bounce_scene_XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw Error("no temporary folder");
        path_ = pattern;
    }
    ~TempFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    fs::path write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

inline std::string base64(const std::string& bytes) {
    static const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t v = 0;
        for (size_t k = 0; k < 3; ++k)
            v = (v << 8) | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? alphabet[(v >> (18 - 6 * k)) & 63] : '=';
    }
    return out;
}

enum Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// The bytes of some values, one after another.
template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

struct GltfBuilder {
    json root{{"asset", {{"version", "2.0"}}}};
    std::string data;

    int add(const char* collection, json item) {
        root[collection].push_back(std::move(item));
        return int(root[collection].size()) - 1;
    }
    int view(const std::string& bytes, int stride = 0) {
        while (data.size() % 4)
            data += '\0';
        json item{{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", bytes.size()}};
        if (stride) item["byteStride"] = stride;
        data += bytes;
        return add("bufferViews", item);
    }
    int accessor(int view, Component component, const char* type, size_t count, size_t offset = 0) {
        return add("accessors", {{"bufferView", view},
                                 {"componentType", int(component)},
                                 {"type", type},
                                 {"count", count},
                                 {"byteOffset", offset}});
    }
    template <class T>
    int accessor_of(const std::vector<T>& values, Component component, const char* type, int components) {
        return accessor(view(bytes_of(values)), component, type, values.size() / size_t(components));
    }
    int vec3s(const std::vector<float>& values) { return accessor_of(values, f32, "VEC3", 3); }
    int vec4s(const std::vector<float>& values) { return accessor_of(values, f32, "VEC4", 4); }
    int vec2s(const std::vector<float>& values) { return accessor_of(values, f32, "VEC2", 2); }
    int scalars(const std::vector<float>& values) { return accessor_of(values, f32, "SCALAR", 1); }

    int mesh(json primitive) { return add("meshes", {{"primitives", json::array({std::move(primitive)})}}); }
    int node(json item) { return add("nodes", std::move(item)); }

    /// A right triangle in z = 0 with corners (0,0,0), (1,0,0), (0,1,0), and the node that shows it.
    int triangle(json primitive_extra = json::object(), json node_extra = json::object()) {
        json primitive{{"attributes", {{"POSITION", vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}};
        primitive.merge_patch(primitive_extra);
        node_extra["mesh"] = mesh(primitive);
        return node(node_extra);
    }

    /// The document, its buffer embedded, and a scene of all nodes that are nobody's child unless there is one.
    std::string text() {
        json out = root;
        if (!data.empty() && !out.contains("buffers"))
            out["buffers"] = {
                {{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}};
        return out.dump();
    }
    Scene load() {
        TempFolder folder;
        return load_gltf(folder.write("test.gltf", text()));
    }
};

/// The message of the Error that loading throws; a test failure (and "") when it throws none.
inline std::string load_error(const std::string& text, const std::string& name = "test.gltf") {
    TempFolder folder;
    try {
        load_gltf(folder.write(name, text));
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "loaded, but an Error was expected";
    return "";
}

} // namespace bounce::testing
