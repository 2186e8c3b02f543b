#include "scene/describe.h"
#include "scene/extent.h"
#include "scene/keyframes.h"

#include <algorithm>

namespace bounce {

namespace {

/// The least green (roughness) and most blue (metallic) of a metallic-roughness picture, in [0, 1].
struct GlossRange {
    float least_roughness = 1;
    float most_metallic = 0;
};

GlossRange gloss_range(const Image8& image) {
    int green = 255, blue = 0;
    for (size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
        green = std::min<int>(green, image.rgba[i + 1]);
        blue = std::max<int>(blue, image.rgba[i + 2]);
    }
    return {float(green) / 255, float(blue) / 255};
}

bool is_glossy(const Scene& scene, const Material& material) {
    GlossRange range{1, 1};
    if (int texture = material.metallic_roughness_texture.texture; texture >= 0)
        range = gloss_range(scene.textures[size_t(texture)].image);
    return material.roughness * range.least_roughness < 0.9f || material.metallic * range.most_metallic > 0;
}

void count_materials(const Scene& scene, const std::vector<bool>& used, bool diffuse_only, SceneFacts& facts) {
    std::vector<bool> textures(scene.textures.size(), false);
    for (size_t m = 0; m < used.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = scene.materials[m];
        ++facts.materials;
        facts.emissive_materials += material.is_emissive();
        facts.alpha_tested_materials += material.alpha_mode == AlphaMode::mask;
        facts.blended_materials += material.alpha_mode == AlphaMode::blend;
        facts.glossy_materials += !diffuse_only && is_glossy(scene, material);
        for (const TextureSlot* slot : {&material.base_colour_texture, &material.metallic_roughness_texture,
                                        &material.normal_texture, &material.emission_texture})
            if (slot->texture >= 0) textures[size_t(slot->texture)] = true;
    }
    for (size_t t = 0; t < textures.size(); ++t)
        if (textures[t]) {
            ++facts.textures;
            facts.texture_bytes += scene.textures[t].image.rgba.size();
        }
}

} // namespace

SceneFacts scene_facts(const Scene& scene, bool diffuse_only, std::span<const Camera> views) {
    SceneFacts facts;
    facts.vertices = scene.vertices.size();
    std::vector<bool> used(scene.materials.size(), false);
    for (const Node& node : scene.nodes) {
        if (node.mesh >= 0)
            for (const Primitive& primitive : scene.meshes[size_t(node.mesh)].primitives) {
                used[size_t(primitive.material)] = true;
                facts.triangles += primitive.index_count / 3;
                ++facts.instances;
                facts.dynamic_instances += node.dynamic;
            }
        if (node.light >= 0 && scene.lights[size_t(node.light)].enabled) {
            LightType type = scene.lights[size_t(node.light)].type;
            facts.point_lights += type == LightType::point;
            facts.spot_lights += type == LightType::spot;
            facts.directional_lights += type == LightType::directional;
            facts.animated_lights = facts.animated_lights || node.dynamic;
        }
    }
    count_materials(scene, used, diffuse_only, facts);
    facts.animation_duration = animation_duration(scene);
    SceneExtent extent = scene_extent(scene, 0, views);
    facts.bounds = extent.bounds;
    if (facts.dynamic_instances > 0) extent = scene_extent_over_animation(scene, views);
    facts.bounds_over_animation = extent.bounds;
    facts.whole_bounds = extent.whole;
    facts.stray_triangles = extent.stray_triangles;
    return facts;
}

SceneFacts shot_facts(const Shot& shot) {
    std::vector<Camera> views{shot.camera};
    for (const PathKey& key : shot.camera_path.keys) {
        views.push_back(shot.camera);
        views.back().position = key.position;
    }
    if (!shot.camera_path.empty()) views.erase(views.begin());
    SceneFacts facts = scene_facts(shot.scene, shot.diffuse_only, views);
    facts.environment = shot.environment.present();
    if (!shot.camera_path.empty())
        facts.animation_duration = std::max(facts.animation_duration, shot.camera_path.keys.back().t);
    return facts;
}

} // namespace bounce
