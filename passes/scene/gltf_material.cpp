#include "core/error.h"
#include "scene/gltf_parts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

float number(const tinygltf::Value& object, const char* key, float otherwise) {
    return object.Has(key) ? float(object.Get(key).GetNumberAsDouble()) : otherwise;
}

glm::vec2 pair(const tinygltf::Value& object, const char* key, glm::vec2 otherwise) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    return {float(value.Get(0).GetNumberAsDouble()), float(value.Get(1).GetNumberAsDouble())};
}

class MaterialReader {
  public:
    MaterialReader(const GltfSource& source, Scene& scene) : source_(source), scene_(scene), textures_(source, scene) {}

    void read_all() {
        for (const tinygltf::Material& from : source_.model.materials)
            read(from);
        if (far_uv_sets_)
            scene_.notes.push_back(fmt::format("{} texture use{} of TEXCOORD_2 or above read TEXCOORD_0 instead",
                                               far_uv_sets_, far_uv_sets_ == 1 ? "" : "s"));
        textures_.decode();
    }

  private:
    template <class Info>
    TextureSlot slot(const Info& info, bool srgb) {
        TextureSlot out;
        out.texture = textures_.use(info.index, srgb);
        out.uv_set = info.texCoord;
        if (auto it = info.extensions.find("KHR_texture_transform"); it != info.extensions.end()) {
            const tinygltf::Value& transform = it->second;
            out.offset = pair(transform, "offset", out.offset);
            out.scale = pair(transform, "scale", out.scale);
            out.rotation = number(transform, "rotation", 0);
            if (transform.Has("texCoord")) out.uv_set = transform.Get("texCoord").GetNumberAsInt();
        }
        if (out.uv_set < 0 || out.uv_set > 1) {
            out.uv_set = 0;
            far_uv_sets_ += out.texture >= 0;
        }
        return out;
    }

    void read(const tinygltf::Material& from) {
        size_t index = scene_.materials.size();
        // The slots are filled in before the material joins the scene: using a texture may add notes, never materials.
        Material to;
        const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
        to.name = from.name.empty() ? fmt::format("material {}", index) : from.name;
        for (int c = 0; c < 4; ++c)
            to.base_colour[c] = std::clamp(float(pbr.baseColorFactor[size_t(c)]), 0.0f, 1.0f);
        to.metallic = std::clamp(float(pbr.metallicFactor), 0.0f, 1.0f);
        to.roughness = std::clamp(float(pbr.roughnessFactor), 0.0f, 1.0f);
        to.base_colour_texture = slot(pbr.baseColorTexture, true);
        to.metallic_roughness_texture = slot(pbr.metallicRoughnessTexture, false);
        to.normal_texture = slot(from.normalTexture, false);
        to.normal_scale = float(from.normalTexture.scale);
        to.emission_texture = slot(from.emissiveTexture, true);

        float strength = 1;
        if (auto it = from.extensions.find("KHR_materials_emissive_strength"); it != from.extensions.end())
            strength = std::max(number(it->second, "emissiveStrength", 1), 0.0f);
        if (from.emissiveFactor.size() == 3)
            for (int c = 0; c < 3; ++c)
                to.emission[c] = std::max(float(from.emissiveFactor[size_t(c)]), 0.0f) * strength;
        if (!std::isfinite(to.emission.r + to.emission.g + to.emission.b))
            throw Error(fmt::format("{}: invalid materials[{}].emissiveStrength {:g}: expected a product with "
                                    "emissiveFactor that a float holds",
                                    source_.where(), index, strength));

        if (from.alphaMode == "MASK") {
            to.alpha_mode = AlphaMode::mask;
            to.alpha_cutoff = std::max(float(from.alphaCutoff), 0.0f);
        } else if (from.alphaMode == "BLEND") {
            to.alpha_mode = AlphaMode::blend;
        } else if (from.alphaMode != "OPAQUE") {
            throw Error(fmt::format("{}: materials[{}].alphaMode '{}' is none of OPAQUE, MASK, BLEND", source_.where(),
                                    index, from.alphaMode.substr(0, 40)));
        }
        to.double_sided = from.doubleSided;
        scene_.materials.push_back(std::move(to));
    }

    const GltfSource& source_;
    Scene& scene_;
    TextureTable textures_;
    int far_uv_sets_ = 0;
};

} // namespace

void read_materials(const GltfSource& source, Scene& scene) {
    MaterialReader(source, scene).read_all();
}

} // namespace bounce
