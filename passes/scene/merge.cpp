#include "scene/merge.h"

#include "core/error.h"
#include "scene/scene_formats.h"

#include <fmt/format.h>
#include <limits>

namespace bounce {

namespace {

std::array<TextureSlot*, 4> slots_of(Material& material) {
    return {&material.base_colour_texture, &material.metallic_roughness_texture, &material.normal_texture,
            &material.emission_texture};
}

} // namespace

SceneMerger::Placed& SceneMerger::load(const std::filesystem::path& file) {
    auto [it, is_new] = placed_.try_emplace(file);
    if (!is_new) return it->second;
    Scene from = load_scene(file);
    constexpr size_t k_most = std::numeric_limits<uint32_t>::max();
    if (into_.vertices.size() + from.vertices.size() > k_most || into_.indices.size() + from.indices.size() > k_most)
        throw Error(file.string() + ": too many vertices in all for 32-bit indices");

    uint32_t first_vertex = uint32_t(into_.vertices.size()), first_index = uint32_t(into_.indices.size());
    int first_material = int(into_.materials.size()), first_texture = int(into_.textures.size());
    into_.vertices.insert(into_.vertices.end(), from.vertices.begin(), from.vertices.end());
    for (uint32_t index : from.indices)
        into_.indices.push_back(first_vertex + index);
    for (Texture& texture : from.textures)
        into_.textures.push_back(std::move(texture));
    for (Material& material : from.materials) {
        for (TextureSlot* slot : slots_of(material))
            if (slot->texture >= 0) slot->texture += first_texture;
        into_.materials.push_back(std::move(material));
    }
    Placed& placed = it->second;
    placed.first_mesh = int(into_.meshes.size());
    for (Mesh& mesh : from.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            primitive.first_index += first_index;
            primitive.material += first_material;
        }
        into_.meshes.push_back(std::move(mesh));
    }
    for (const std::string& note : from.notes)
        into_.notes.push_back(file.filename().string() + ": " + note);
    placed.scene.nodes = std::move(from.nodes);
    placed.scene.lights = std::move(from.lights);
    placed.scene.animations = std::move(from.animations);
    return placed;
}

int SceneMerger::place(const std::filesystem::path& file, const Node& root) {
    Placed& placed = load(file);
    int parent = int(into_.nodes.size());
    into_.nodes.push_back(root);
    int first_node = int(into_.nodes.size()), first_light = int(into_.lights.size());
    for (Node node : placed.scene.nodes) {
        node.parent = node.parent < 0 ? parent : node.parent + first_node;
        if (node.mesh >= 0) node.mesh += placed.first_mesh;
        if (node.light >= 0) node.light += first_light;
        node.camera = -1;
        into_.nodes.push_back(std::move(node));
    }
    into_.lights.insert(into_.lights.end(), placed.scene.lights.begin(), placed.scene.lights.end());
    for (Animation animation : placed.scene.animations) {
        for (AnimationChannel& channel : animation.channels)
            channel.node += first_node;
        into_.animations.push_back(std::move(animation));
    }
    return parent;
}

void drop_unused_textures(Scene& scene) {
    std::vector<int> moved(scene.textures.size(), -1);
    for (Material& material : scene.materials)
        for (TextureSlot* slot : slots_of(material))
            if (slot->texture >= 0) moved[size_t(slot->texture)] = 0;
    std::vector<Texture> kept;
    for (size_t i = 0; i < moved.size(); ++i) {
        if (moved[i] < 0) continue;
        moved[i] = int(kept.size());
        kept.push_back(std::move(scene.textures[i]));
    }
    scene.textures = std::move(kept);
    for (Material& material : scene.materials)
        for (TextureSlot* slot : slots_of(material))
            if (slot->texture >= 0) slot->texture = moved[size_t(slot->texture)];
}

} // namespace bounce
