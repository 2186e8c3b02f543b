#pragma once
// The parts of load_gltf, one file each. All want a checked source, append to the scene, and add to its notes.

#include "scene/gltf_source.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <span>

namespace bounce {

/// glTF materials in order, and the textures that they use.
void read_materials(const GltfSource& source, Scene& scene);

/// One texture of the scene for each (image, sampler, colour space) that a material uses.
class TextureTable {
  public:
    TextureTable(const GltfSource& source, Scene& scene) : source_(source), scene_(scene) {}

    /// The index in Scene::textures of glTF texture `texture`, or -1 when it has no image that can be read.
    int use(int texture, bool srgb);
    /// Decodes the images on all cores. A picture that cannot be decoded leaves its slots without a texture, which
    /// reads as white, and a note. Throws Error when an image's file is missing or may not be read, or when the images
    /// say of themselves that they hold more pixels than a scene may have.
    void decode();

  private:
    struct Key {
        int image;
        Wrap wrap_u, wrap_v;
        bool nearest, srgb;
        auto operator<=>(const Key&) const = default;
    };
    /// The bytes of an image: of a view of the scene's buffers, or read into `file`. Empty for an image of neither.
    std::span<const unsigned char> encoded(int image, std::vector<unsigned char>& file) const;
    std::string image_name(int image) const;
    void drop(int texture);

    const GltfSource& source_;
    Scene& scene_;
    std::map<Key, int> made_;
    std::vector<int> images_; ///< per texture: the image it shows
    std::vector<bool> noted_; ///< glTF textures already complained about
};

/// Meshes, with one Mesh for each of the file's. Points and lines are left out.
void read_meshes(const GltfSource& source, Scene& scene);

/// The chosen scene's nodes, parents first, with cameras and lights. Returns for each glTF node its index in
/// Scene::nodes, or -1.
std::vector<int> read_nodes(const GltfSource& source, Scene& scene);

void read_animations(const GltfSource& source, const std::vector<int>& node_index, Scene& scene);

/// Sets Node::dynamic from the animations, the paths and the parents.
void mark_dynamic_nodes(Scene& scene);

} // namespace bounce
