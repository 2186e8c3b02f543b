#pragma once
// The scene on the GPU: geometry, draws, materials, lights, textures. Uploaded once; draws and lights follow each
// frame. GpuTexture arrays are bucketed by size (for compute); raster passes bind 2D views of their layers, so nothing
// is stored twice.

#include "core/revision.h"
#include "gpu/objects.h"
#include "scene/scene.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace bounce {

// std430 mirrors of glsl/lib/scene.glsl and glsl/lib/light.glsl.
struct GpuDraw {
    glm::mat4 world, previous_world, normal_matrix;
    uint32_t material, first_index, index_count, flags;
    static constexpr uint32_t k_dynamic = 1, k_mirrored = 2; ///< bits of `flags`
};
static_assert(sizeof(GpuDraw) == 208);
struct GpuTextureUse {
    int32_t array = -1, layer = 0;
    uint32_t uv_set = 0;
    float rotation = 0;
    glm::vec2 offset{0}, scale{1};
};
struct GpuMaterial {
    glm::vec4 base_colour;
    glm::vec3 emission;
    float alpha_cutoff;
    float metallic, roughness, normal_scale;
    uint32_t flags;
    GpuTextureUse base_colour_texture, metallic_roughness_texture, normal_texture, emission_texture;
};
static_assert(sizeof(GpuMaterial) == 176);
struct GpuLight {
    glm::vec3 position;
    uint32_t type;
    glm::vec3 direction;
    float inner_cone_cos;
    glm::vec3 intensity;
    float outer_cone_cos;
    float radius, angular_radius;
    int32_t shadow_base, shadow_count;
};
static_assert(sizeof(GpuLight) == 64);

/// Layers of the shadow array that a light needs: 6 for a point light, else 1.
int shadow_views_of(LightType type);

/// What a pass may use of the scene, each with a revision of its own.
enum class ScenePart { geometry, textures, environment, materials, static_draws, dynamic_draws, lights };
inline constexpr int k_scene_parts = 7;

class GpuScene {
  public:
    static constexpr int k_texture_arrays = 8; ///< samplers scene_textures[8]

    /// Uploads everything. Throws Error when memory or limits do not suffice.
    GpuScene(const Scene& scene, const Environment& environment);

    /// Draws and lights of this frame. Lights get their shadow layers in order. `moving_lights`: some move by
    /// themselves, so that a change of lights is no edit unless scene_edited() tells of it.
    void update(const SceneState& state, bool moving_lights = false);
    /// After an edit: what the last update() would have been given with the scene as it is now. Differences of what
    /// moves by itself count as edits.
    void scene_edited(const SceneState& state);
    /// What emission and lights are multiplied by from the next updates on (scene/pre_exposure.h).
    void set_pre_exposure(float pre_exposure) { pre_exposure_ = pre_exposure; }
    float pre_exposure() const { return pre_exposure_; }
    /// Materials as edited in a panel.
    void update_materials(const std::vector<Material>& materials);

    const Buffer& vertices() const { return vertices_; }
    const Buffer& indices() const { return indices_; }
    const Buffer& draws() const { return draws_; }
    const Buffer& materials() const { return materials_; }
    const Buffer& lights() const { return lights_; }
    const GpuTexture& environment() const { return environment_; }
    /// LobeAlbedoTable; row = roughness.
    const GpuTexture& lobe_albedo() const { return lobe_albedo_; }
    /// Array i, or a 1×1 white stand-in.
    const GpuTexture& texture_array(int i) const;
    GLuint texture_array_sampler(int i) const;
    int texture_array_count() const { return int(arrays_.size()); }

    const std::vector<GpuDraw>& draw_list() const { return draw_list_; }
    const std::vector<GpuLight>& light_list() const { return light_list_; }
    /// Emission is pre-exposed in it, as on the GPU.
    const std::vector<Material>& material_list() const { return material_list_; }
    int shadow_view_count() const { return shadow_view_count_; }
    GLuint vertex_array() const { return vertex_array_.id(); }

    /// The 2D view and sampler of a material slot's texture; white (or flat blue for normals) where there is none.
    struct Bound {
        GLuint texture = 0, sampler = 0;
    };
    Bound base_colour(int material) const { return slots_[size_t(material)][0]; }
    Bound metallic_roughness(int material) const { return slots_[size_t(material)][1]; }
    Bound normal(int material) const { return slots_[size_t(material)][2]; }
    Bound emission(int material) const { return slots_[size_t(material)][3]; }

    const Revision& revision(ScenePart part) const { return revisions_[size_t(part)]; }

    uint64_t geometry_bytes() const;
    uint64_t texture_bytes() const;

  private:
    struct Array {
        GpuTexture texture;
        GLuint sampler = 0;
    };
    void upload_textures(const Scene& scene);
    GLuint sampler_for(Wrap u, Wrap v, bool nearest);
    GpuTextureUse use_of(const TextureSlot& slot) const;

    Buffer vertices_, indices_, draws_, materials_, lights_;
    VertexArray vertex_array_;
    GpuTexture environment_, lobe_albedo_, white_, white_array_, flat_normal_;
    std::vector<Array> arrays_;
    std::vector<std::pair<int, int>> places_; ///< per Scene::textures: array, layer
    std::vector<GpuTexture> views_;           ///< per Scene::textures
    std::vector<GLuint> view_samplers_;
    std::map<int, Sampler> samplers_;
    std::vector<std::array<Bound, 4>> slots_; ///< per material
    std::vector<GpuDraw> draw_list_;
    std::vector<GpuLight> light_list_;
    std::vector<Material> material_list_;
    int shadow_view_count_ = 0;
    std::array<Revision, k_scene_parts> revisions_;
    uint64_t draw_edits_ = 0, light_edits_ = 0; ///< of what moves by itself
    float pre_exposure_ = 1;
};

} // namespace bounce
