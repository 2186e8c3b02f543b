#pragma once
// A glTF file opened and checked: tinygltf's model of it, with the buffers' bytes in place. Everything that reads from
// one may rely on: indices point at something, views lie in their buffers, accessors in their views, the node graph is
// a forest.

#include <filesystem>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace bounce {

struct GltfSource {
    std::filesystem::path path;
    tinygltf::Model model;               ///< without images (see `images`)
    std::vector<tinygltf::Image> images; ///< name, uri, bufferView and mimeType only; decoded on demand
    std::vector<std::string> notes;

    std::string where() const { return path.string(); }
};

/// Throws Error with everything that is wrong with the file.
GltfSource open_gltf(const std::filesystem::path& path);

/// Bytes of one element of an accessor, with the padding that columns of small matrices have. 0 for an unknown type.
size_t gltf_element_bytes(int component_type, int type);
/// TINYGLTF_TYPE_… of "VEC3" …; -1 when there is none of that name.
int gltf_type(const std::string& name);

} // namespace bounce
