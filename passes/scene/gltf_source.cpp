#include "scene/gltf_source.h"

#include "core/error.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/text.h"
#include "scene/gltf_bounds.h"
#include "scene/gltf_file.h"
#include "scene/gltf_schema.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace bounce {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

// KHR_mesh_quantization only allows more component types, and every type is read.
const std::set<std::string> k_supported{"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                        "KHR_texture_transform", "KHR_mesh_quantization"};

// What a material loses with an extension that is not read.
constexpr std::pair<std::string_view, std::string_view> k_unread_materials[]{
    {"KHR_materials_unlit", "shaded by the light that falls on it, not shown as painted"},
    {"KHR_materials_pbrSpecularGlossiness",
     "with its metallic-roughness values only (white metal of roughness 1 if it has none)"},
    {"KHR_materials_ior", "with the index of refraction 1.5 (F0 = 0.04)"},
    {"KHR_materials_specular", "with the whole, white specular reflection of the index of refraction 1.5"},
    {"KHR_materials_transmission", "opaque"},
    {"KHR_materials_diffuse_transmission", "opaque"},
};

std::vector<std::string> text_list(const json& root, const char* key, ErrorList& errors) {
    std::vector<std::string> out;
    auto it = root.find(key);
    if (it == root.end()) return out;
    bool texts = it->is_array() && std::all_of(it->begin(), it->end(), [](const json& v) { return v.is_string(); });
    if (!texts) {
        errors.add(fmt::format("{} must be an array of texts, but is {}", key, json_kind(*it)));
        return out;
    }
    for (const json& name : *it)
        if (std::find(out.begin(), out.end(), name.get<std::string>()) == out.end()) out.push_back(name);
    return out;
}

/// By name, how many materials use each extension that is not read.
std::map<std::string, size_t> material_extensions(const json& root) {
    std::map<std::string, size_t> count;
    auto materials = root.find("materials");
    if (materials == root.end() || !materials->is_array()) return count;
    for (const json& material : *materials) {
        if (!material.is_object() || !material.contains("extensions") || !material["extensions"].is_object()) continue;
        for (const auto& [name, value] : material["extensions"].items())
            if (!k_supported.contains(name)) ++count[name];
    }
    return count;
}

void check_extensions(const json& root, GltfSource& source, ErrorList& errors) {
    std::vector<std::string> required = text_list(root, "extensionsRequired", errors);
    for (const std::string& name : required)
        if (!k_supported.contains(name))
            errors.add("the file requires the extension " + name + ", which is not supported (supported: " +
                       join({k_supported.begin(), k_supported.end()}, ", ") + ")");
    const std::map<std::string, size_t> of_materials = material_extensions(root);
    for (const auto& [name, count] : of_materials) {
        const auto effect = std::find_if(std::begin(k_unread_materials), std::end(k_unread_materials),
                                         [&name = name](const auto& entry) { return name == entry.first; });
        source.notes.push_back(fmt::format("extension {} is ignored: {} material{} {}", name, count,
                                           count == 1 ? "" : "s",
                                           effect == std::end(k_unread_materials) ? "without it" : effect->second));
    }
    for (const std::string& name : text_list(root, "extensionsUsed", errors))
        if (!k_supported.contains(name) && !of_materials.contains(name))
            source.notes.push_back("extension " + name + " is ignored");
}

void check_version(const json& root, ErrorList& errors) {
    auto major_minor = [&](const char* key) -> std::pair<int, int> {
        const json& asset = root["asset"];
        if (!asset.contains(key)) return {2, 0};
        const std::string text = asset[key];
        int major = -1, minor = -1;
        if (std::sscanf(text.c_str(), "%4d.%4d", &major, &minor) != 2 || major < 0 || minor < 0) {
            errors.add(fmt::format("asset.{} '{}' is not of the form 2.0", key, text.substr(0, 40)));
            return {2, 0};
        }
        return {major, minor};
    };
    auto version = major_minor("version"), minimum = major_minor("minVersion");
    if (version.first != 2)
        errors.add(fmt::format("asset.version is {}.{}; only glTF 2.x can be read", version.first, version.second));
    else if (minimum > std::pair{2, 0})
        errors.add(fmt::format("asset.minVersion is {}.{}; only glTF 2.0 can be read", minimum.first, minimum.second));
}

/// What the file holds and Bounce does not read, before the shape check removes it.
void note_unread(const json& root, GltfSource& source) {
    auto list = [&](const char* key) -> const json& {
        static const json none = json::array();
        auto it = root.find(key);
        return it != root.end() && it->is_array() ? *it : none;
    };
    if (size_t skins = list("skins").size())
        source.notes.push_back(
            fmt::format("skinning is not supported: {} skin{} ignored, meshes stay in their rest pose", skins,
                        skins == 1 ? "" : "s"));
    size_t morphed = 0;
    for (const json& mesh : list("meshes")) {
        if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
        for (const json& primitive : mesh["primitives"])
            morphed += primitive.is_object() && primitive.contains("targets");
    }
    if (morphed)
        source.notes.push_back(fmt::format("morph targets are not supported: {} primitive{} keep{} the base shape",
                                           morphed, morphed == 1 ? "" : "s", morphed == 1 ? "s" : ""));
    size_t occlusion = 0;
    for (const json& material : list("materials"))
        occlusion += material.is_object() && material.contains("occlusionTexture");
    if (occlusion)
        source.notes.push_back(
            fmt::format("baked occlusion textures are ignored ({} material{})", occlusion, occlusion == 1 ? "" : "s"));
}

std::vector<std::vector<unsigned char>> load_buffers(const json& root, GltfFile& file, ErrorList& errors) {
    std::vector<std::vector<unsigned char>> buffers;
    if (!root.contains("buffers")) return buffers;
    std::vector<bool> viewed(root["buffers"].size(), false);
    if (root.contains("bufferViews"))
        for (const json& view : root["bufferViews"])
            viewed[view["buffer"].get<size_t>()] = true;
    for (const json& item : root["buffers"]) {
        std::string what = fmt::format("buffers[{}]", buffers.size());
        size_t length = item["byteLength"].get<size_t>();
        std::vector<unsigned char>& bytes = buffers.emplace_back();
        try {
            if (item.contains("uri")) {
                bytes = read_uri(item["uri"].get<std::string>(), file.path.parent_path(), what, k_max_buffer_bytes);
            } else if (buffers.size() == 1 && file.binary) {
                bytes.assign(file.binary->begin(), file.binary->end());
            } else {
                if (viewed[buffers.size() - 1]) throw Error(what + " has no uri, and there is no binary chunk for it");
                continue; // the specification allows it, for extensions that bring the bytes
            }
            if (bytes.size() < length)
                throw Error(fmt::format("{}.byteLength is {}, but there are {} bytes", what, length, bytes.size()));
            if (length >= k_max_buffer_bytes)
                throw Error(
                    fmt::format("{}.byteLength is {}; buffers of 2 GiB and more are not supported", what, length));
            bytes.resize(length);
        } catch (const Error& error) {
            errors.add(error.what());
            bytes.clear();
        }
    }
    return buffers;
}

// tinygltf wants a view behind every accessor that a primitive uses. Those without one read as zeros: they share one
// view of a buffer of zeros.
void give_views_to_zeros(json& root, std::vector<std::vector<unsigned char>>& buffers) {
    if (!root.contains("accessors")) return;
    size_t longest = 0;
    for (json& accessor : root["accessors"]) {
        if (accessor.contains("bufferView")) continue;
        size_t bytes = gltf_element_bytes(accessor["componentType"].get<int>(), gltf_type(accessor["type"]));
        longest = std::max(longest, bytes * accessor["count"].get<size_t>());
        if (!root.contains("bufferViews")) root["bufferViews"] = json::array();
        accessor["bufferView"] = root["bufferViews"].size();
        accessor["byteOffset"] = 0;
    }
    if (longest == 0) return;
    root["bufferViews"].push_back({{"buffer", buffers.size()}, {"byteLength", longest}});
    buffers.emplace_back(longest, 0);
}

// Members that the specification makes optional and tinygltf 2.7 wants, and channels it cannot read.
void fill_in_for_parser(json& root) {
    if (root.contains("accessors"))
        for (json& accessor : root["accessors"]) {
            if (!accessor.contains("sparse")) continue;
            for (const char* part : {"indices", "values"})
                if (!accessor["sparse"][part].contains("byteOffset")) accessor["sparse"][part]["byteOffset"] = 0;
        }
    if (root.contains("animations"))
        for (json& animation : root["animations"]) {
            json kept = json::array();
            for (json& channel : animation["channels"])
                if (channel["target"].contains("node")) kept.push_back(std::move(channel));
            animation["channels"] = std::move(kept);
        }
    auto lights = json::json_pointer("/extensions/KHR_lights_punctual/lights");
    if (root.contains(lights))
        for (json& light : root[lights])
            if (light["type"] == "spot" && !light.contains("spot")) light["spot"] = json::object();
}

void check_cameras(const json& root, ErrorList& errors) {
    if (!root.contains("cameras")) return;
    for (size_t i = 0; i < root["cameras"].size(); ++i) {
        const json& camera = root["cameras"][i];
        const std::string type = camera["type"];
        if (type != "perspective" && type != "orthographic")
            errors.add(
                fmt::format("cameras[{}].type '{}' is neither perspective nor orthographic", i, type.substr(0, 40)));
        else if (!camera.contains(type))
            errors.add(fmt::format("cameras[{}].{} is missing", i, type));
    }
}

std::vector<tinygltf::Image> take_images(json& root) {
    std::vector<tinygltf::Image> images;
    if (!root.contains("images")) return images;
    for (const json& item : root["images"]) {
        tinygltf::Image& image = images.emplace_back();
        image.name = item.value("name", "");
        image.uri = item.value("uri", "");
        image.mimeType = item.value("mimeType", "");
        if (item.contains("bufferView")) image.bufferView = item["bufferView"].get<int>();
    }
    root.erase("images");
    return images;
}

} // namespace

size_t gltf_element_bytes(int component_type, int type) {
    size_t component = 0;
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        component = 1;
        break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        component = 2;
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        component = 4;
        break;
    default:
        return 0;
    }
    auto columns = [&](size_t n) { return n * ((n * component + 3) / 4 * 4); };
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return component;
    case TINYGLTF_TYPE_VEC2:
        return component * 2;
    case TINYGLTF_TYPE_VEC3:
        return component * 3;
    case TINYGLTF_TYPE_VEC4:
        return component * 4;
    case TINYGLTF_TYPE_MAT2:
        return columns(2);
    case TINYGLTF_TYPE_MAT3:
        return columns(3);
    case TINYGLTF_TYPE_MAT4:
        return columns(4);
    default:
        return 0;
    }
}

int gltf_type(const std::string& name) {
    static const std::map<std::string, int> types{{"SCALAR", TINYGLTF_TYPE_SCALAR}, {"VEC2", TINYGLTF_TYPE_VEC2},
                                                  {"VEC3", TINYGLTF_TYPE_VEC3},     {"VEC4", TINYGLTF_TYPE_VEC4},
                                                  {"MAT2", TINYGLTF_TYPE_MAT2},     {"MAT3", TINYGLTF_TYPE_MAT3},
                                                  {"MAT4", TINYGLTF_TYPE_MAT4}};
    auto it = types.find(name);
    return it == types.end() ? -1 : it->second;
}

GltfSource open_gltf(const fs::path& path) {
    GltfFile file = read_gltf_file(path);
    json& root = file.json;
    GltfSource source;
    source.path = path;
    source.notes = file.notes;

    // Each stage may rely on the ones before it, so errors are told together within a stage.
    ErrorList errors;
    check_extensions(root, source, errors);
    errors.throw_if_any(source.where());
    note_unread(root, source);
    check_gltf_shape(root, errors);
    errors.throw_if_any(source.where());
    check_version(root, errors);
    check_gltf_graph(root, errors);
    check_cameras(root, errors);
    auto buffers = load_buffers(root, file, errors);
    errors.throw_if_any(source.where());
    std::vector<size_t> sizes;
    for (const auto& bytes : buffers)
        sizes.push_back(bytes.size());
    check_gltf_bounds(root, sizes, errors);
    errors.throw_if_any(source.where());

    give_views_to_zeros(root, buffers);
    fill_in_for_parser(root);
    source.images = take_images(root);
    root.erase("buffers");

    // The bytes are read here and not by tinygltf, which refuses files longer than byteLength and data: URIs of most
    // media types, and decodes images one after another.
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    tinygltf::TinyGLTF parser;
    std::string problem, warning;
    bool parsed = false;
    try {
        parsed = parser.LoadASCIIFromString(&source.model, &problem, &warning, text.data(), unsigned(text.size()), "",
                                            tinygltf::NO_REQUIRE);
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (!parsed) throw Error(source.where() + ": " + std::string(trim(problem)));
    for (auto& bytes : buffers)
        source.model.buffers.emplace_back().data = std::move(bytes);
    return source;
}

} // namespace bounce
