#include "gpu_scene/gpu_scene.h"

#include "core/digest.h"
#include "core/error.h"
#include "scene/lobe_albedo.h"
#include "scene/normal_transform.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

int shadow_views_of(LightType type) {
    return type == LightType::point ? 6 : 1;
}

static GpuTexture one_texel(const char* name, TextureKind kind, glm::vec4 value) {
    GpuTexture texture({kind, GL_RGBA8, {1, 1, 1}, 1}, name);
    texture.clear(value);
    return texture;
}

GpuScene::GpuScene(const Scene& scene, const Environment& environment)
    : vertices_(scene.vertices.size() * sizeof(Vertex), scene.vertices.data(), "scene.vertices"),
      indices_(scene.indices.size() * sizeof(uint32_t), scene.indices.data(), "scene.indices"),
      vertex_array_("scene vertices"), white_(one_texel("white", TextureKind::texture_2d, glm::vec4(1))),
      white_array_(one_texel("white array", TextureKind::texture_2d_array, glm::vec4(1))),
      flat_normal_(one_texel("flat normal", TextureKind::texture_2d, {0.5f, 0.5f, 1, 1})) {
    GLuint array = vertex_array_.id();
    glVertexArrayVertexBuffer(array, 0, vertices_.id(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(array, indices_.id());
    for (GLuint location = 0; location < 5; ++location) {
        glEnableVertexArrayAttrib(array, location);
        glVertexArrayAttribBinding(array, location, 0);
        if (location < 3) glVertexArrayAttribFormat(array, location, 4, GL_FLOAT, GL_FALSE, 16 * location);
    }
    glVertexArrayAttribFormat(array, 3, 2, GL_FLOAT, GL_FALSE, 48);
    glVertexArrayAttribIFormat(array, 4, 2, GL_UNSIGNED_INT, 56);

    const Image& map = environment.map;
    if (map.empty()) {
        environment_ = GpuTexture({TextureKind::texture_2d, GL_RGBA16F, {1, 1, 1}, 1}, "scene.environment");
        environment_.clear(glm::vec4(1));
    } else {
        environment_ =
            GpuTexture({TextureKind::texture_2d, GL_RGBA32F, {map.width, map.height, 1}, 1}, "scene.environment");
        GLenum format = map.channels == 4 ? GL_RGBA : GL_RGB;
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(environment_.id(), 0, 0, 0, map.width, map.height, format, GL_FLOAT, map.pixels.data());
        glTextureParameteri(environment_.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    }
    constexpr int k_table = LobeAlbedoTable::k_size;
    lobe_albedo_ = GpuTexture({TextureKind::texture_2d, GL_RG32F, {k_table, k_table, 1}, 1}, "scene.lobe_albedo");
    glTextureSubImage2D(lobe_albedo_.id(), 0, 0, 0, k_table, k_table, GL_RG, GL_FLOAT,
                        lobe_albedo_table().entries.data());
    upload_textures(scene);
    update_materials(scene.materials);
    // What is uploaded once is told from all others ever uploaded.
    static uint64_t uploads = 0;
    ++uploads;
    for (ScenePart part : {ScenePart::geometry, ScenePart::textures, ScenePart::environment})
        revisions_[size_t(part)][Cause::lasting] = uploads;
}

const GpuTexture& GpuScene::texture_array(int i) const {
    return i < int(arrays_.size()) ? arrays_[size_t(i)].texture : white_array_;
}

GLuint GpuScene::texture_array_sampler(int i) const {
    return i < int(arrays_.size()) ? arrays_[size_t(i)].sampler : 0;
}

GpuTextureUse GpuScene::use_of(const TextureSlot& slot) const {
    GpuTextureUse use;
    if (slot.texture < 0) return use;
    std::tie(use.array, use.layer) = places_[size_t(slot.texture)];
    use.uv_set = uint32_t(slot.uv_set);
    use.rotation = slot.rotation;
    use.offset = slot.offset;
    use.scale = slot.scale;
    return use;
}

void GpuScene::update_materials(const std::vector<Material>& materials) {
    material_list_ = materials;
    for (Material& material : material_list_)
        material.emission *= pre_exposure_;
    std::vector<GpuMaterial> packed;
    slots_.clear();
    auto bound = [&](const TextureSlot& slot, const GpuTexture& fallback) -> Bound {
        if (slot.texture < 0) return {fallback.id(), 0};
        return {views_[size_t(slot.texture)].id(), view_samplers_[size_t(slot.texture)]};
    };
    for (const Material& m : material_list_) {
        GpuMaterial out;
        out.base_colour = m.base_colour;
        out.emission = m.emission;
        out.alpha_cutoff = m.alpha_mode == AlphaMode::mask    ? m.alpha_cutoff
                           : m.alpha_mode == AlphaMode::blend ? -2.0f
                                                              : -1.0f;
        out.metallic = m.metallic;
        out.roughness = m.roughness;
        out.normal_scale = m.normal_scale;
        out.flags = m.double_sided ? 1u : 0u;
        out.base_colour_texture = use_of(m.base_colour_texture);
        out.metallic_roughness_texture = use_of(m.metallic_roughness_texture);
        out.normal_texture = use_of(m.normal_texture);
        out.emission_texture = use_of(m.emission_texture);
        packed.push_back(out);
        slots_.push_back({bound(m.base_colour_texture, white_), bound(m.metallic_roughness_texture, white_),
                          bound(m.normal_texture, flat_normal_), bound(m.emission_texture, white_)});
    }
    Digest digest;
    for (const Material& m : materials)
        digest.add(m.alpha_mode); // the rest of it is packed
    uint64_t bytes = packed.size() * sizeof(GpuMaterial);
    revisions_[size_t(ScenePart::materials)][Cause::lasting] = digest.bytes(packed.data(), bytes).value();
    if (materials_.bytes() != bytes || !materials_)
        materials_ = Buffer(bytes, packed.data(), "scene.materials");
    else
        materials_.update(0, bytes, packed.data());
}

static std::vector<GpuDraw> pack_draws(const SceneState& state) {
    std::vector<GpuDraw> draws;
    for (const Instance& instance : state.instances) {
        GpuDraw& draw = draws.emplace_back();
        draw.world = instance.world;
        draw.previous_world = instance.previous_world;
        NormalTransform turn(instance.world);
        draw.normal_matrix = glm::mat4(turn.matrix);
        draw.material = uint32_t(instance.primitive.material);
        draw.first_index = instance.primitive.first_index;
        draw.index_count = instance.primitive.index_count;
        draw.flags = (instance.dynamic ? GpuDraw::k_dynamic : 0u) | (turn.mirrored ? GpuDraw::k_mirrored : 0u);
    }
    return draws;
}

static std::vector<GpuLight> pack_lights(const SceneState& state, float pre_exposure) {
    std::vector<GpuLight> lights;
    int shadow_base = 0;
    for (const Light& light : state.lights) {
        GpuLight& out = lights.emplace_back();
        out.position = light.position;
        out.type = uint32_t(light.type);
        out.direction = light.direction;
        out.inner_cone_cos = std::cos(light.inner_cone);
        out.intensity = light.intensity * pre_exposure;
        out.outer_cone_cos = std::cos(light.outer_cone);
        out.radius = light.radius;
        out.angular_radius = light.angular_radius;
        out.shadow_base = shadow_base;
        out.shadow_count = shadow_views_of(light.type);
        shadow_base += out.shadow_count;
    }
    return lights;
}

/// Of the draws that stand, or of those that move by themselves; each with its place in the list.
static uint64_t digest_of_draws(const std::vector<GpuDraw>& draws, bool dynamic) {
    Digest digest;
    for (size_t i = 0; i < draws.size(); ++i)
        if (((draws[i].flags & GpuDraw::k_dynamic) != 0) == dynamic) digest.add(i).add(draws[i]);
    return digest.value();
}

static uint64_t digest_of_lights(const std::vector<GpuLight>& lights) {
    return Digest().bytes(lights.data(), lights.size() * sizeof(GpuLight)).value();
}

void GpuScene::update(const SceneState& state, bool moving_lights) {
    draw_list_ = pack_draws(state);
    light_list_ = pack_lights(state, pre_exposure_);
    shadow_view_count_ = 0;
    for (const GpuLight& light : light_list_)
        shadow_view_count_ += light.shadow_count;
    auto upload = [](Buffer& buffer, const auto& list, const char* name) {
        uint64_t bytes = list.size() * sizeof(list[0]);
        if (!buffer || buffer.bytes() != bytes)
            buffer = Buffer(bytes, list.data(), name);
        else
            buffer.update(0, bytes, list.data());
    };
    upload(draws_, draw_list_, "scene.draws");
    upload(lights_, light_list_, "scene.lights");
    revisions_[size_t(ScenePart::static_draws)][Cause::lasting] = digest_of_draws(draw_list_, false);
    Revision& dynamic = revisions_[size_t(ScenePart::dynamic_draws)];
    dynamic[Cause::lasting] = draw_edits_;
    dynamic[Cause::passing] = digest_of_draws(draw_list_, true);
    Revision& lights = revisions_[size_t(ScenePart::lights)];
    uint64_t digest = digest_of_lights(light_list_);
    lights[Cause::lasting] = moving_lights ? light_edits_ : digest;
    lights[Cause::passing] = moving_lights ? digest : 0;
}

void GpuScene::scene_edited(const SceneState& state) {
    draw_edits_ += digest_of_draws(pack_draws(state), true) != digest_of_draws(draw_list_, true);
    light_edits_ += digest_of_lights(pack_lights(state, pre_exposure_)) != digest_of_lights(light_list_);
}

uint64_t GpuScene::geometry_bytes() const {
    return vertices_.bytes() + indices_.bytes() + draws_.bytes() + materials_.bytes() + lights_.bytes();
}

uint64_t GpuScene::texture_bytes() const {
    uint64_t bytes = bounce::texture_bytes(environment_.desc()) + bounce::texture_bytes(lobe_albedo_.desc());
    for (const Array& array : arrays_)
        bytes += bounce::texture_bytes(array.texture.desc());
    return bytes;
}

} // namespace bounce
