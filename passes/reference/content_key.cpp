#include "reference/content_key.h"

#include <cstring>
#include <fmt/format.h>

namespace bounce {

void ContentHash::mix(uint64_t word) {
    // Two multiply-xorshift chains of different constants.
    a_ = (a_ ^ word) * 0xff51afd7ed558ccdull;
    a_ ^= a_ >> 32;
    b_ = (b_ ^ (word << 31 | word >> 33)) * 0xc4ceb9fe1a85ec53ull;
    b_ ^= b_ >> 29;
}

void ContentHash::add(const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    mix(size);
    for (; size >= 8; size -= 8, bytes += 8) {
        uint64_t word;
        std::memcpy(&word, bytes, 8);
        mix(word);
    }
    if (size) {
        uint64_t word = 0;
        std::memcpy(&word, bytes, size);
        mix(word);
    }
}

void ContentHash::add(const std::string& text) {
    add(text.data(), text.size());
}

std::string ContentHash::text() const {
    return fmt::format("{:016x}{:016x}", a_, b_ ^ a_);
}

static void add_slot(ContentHash& hash, const TextureSlot& slot) {
    hash.add_value(slot.texture);
    hash.add_value(slot.uv_set);
    hash.add_value(slot.offset);
    hash.add_value(slot.scale);
    hash.add_value(slot.rotation);
}

static void add_material(ContentHash& hash, const Material& m) {
    hash.add_value(m.base_colour);
    hash.add_value(m.metallic);
    hash.add_value(m.roughness);
    hash.add_value(m.emission);
    hash.add_value(m.normal_scale);
    hash.add_value(int(m.alpha_mode));
    hash.add_value(m.alpha_cutoff);
    for (const TextureSlot* slot :
         {&m.base_colour_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emission_texture}) {
        add_slot(hash, *slot);
    }
}

static void add_light(ContentHash& hash, const Light& light) {
    hash.add_value(uint32_t(light.type));
    hash.add_value(light.position);
    hash.add_value(light.direction);
    hash.add_value(light.intensity);
    hash.add_value(light.inner_cone);
    hash.add_value(light.outer_cone);
    hash.add_value(light.radius);
    hash.add_value(light.angular_radius);
    hash.add_value(int(light.enabled));
}

static void add_camera(ContentHash& hash, const Camera& camera) {
    hash.add_value(camera.position);
    hash.add_value(camera.target);
    hash.add_value(camera.up);
    hash.add_value(camera.vfov);
    hash.add_value(camera.near_plane);
}

static void add_scene(ContentHash& hash, const Scene& scene) {
    hash.add(scene.vertices.data(), scene.vertices.size() * sizeof(Vertex));
    hash.add(scene.indices.data(), scene.indices.size() * sizeof(uint32_t));
    for (const Material& material : scene.materials)
        add_material(hash, material);
    for (const Texture& texture : scene.textures) {
        hash.add_value(texture.image.width);
        hash.add_value(texture.image.height);
        hash.add_value(int(texture.wrap_u) | int(texture.wrap_v) << 4 | int(texture.nearest) << 8 |
                       int(texture.srgb) << 9);
        hash.add(texture.image.rgba.data(), texture.image.rgba.size());
    }
}

static void add_state(ContentHash& hash, const SceneState& state) {
    for (const Instance& instance : state.instances) {
        hash.add_value(instance.world);
        hash.add_value(instance.primitive.first_index);
        hash.add_value(instance.primitive.index_count);
        hash.add_value(instance.primitive.material);
    }
    for (const Light& light : state.lights)
        add_light(hash, light);
}

static void add_environment(ContentHash& hash, const Environment& environment) {
    hash.add_value(environment.radiance);
    hash.add_value(environment.map.width);
    hash.add(environment.map.pixels.data(), environment.map.pixels.size() * sizeof(float));
}

std::string shot_digest(const Shot& shot, int frames) {
    ContentHash hash;
    hash.add_value(int(shot.diffuse_only));
    hash.add_value(int(shot.normal_maps));
    hash.add_value(shot.fps);
    add_scene(hash, shot.scene);
    add_environment(hash, shot.environment);
    for (int frame = 0; frame < frames; ++frame) {
        const ShotState state = evaluate_shot(shot, frame);
        hash.add_value(state.time);
        add_camera(hash, state.camera);
        add_state(hash, state.scene);
    }
    return hash.text();
}

std::string content_key(const Shot& shot, const ShotState& state, const ReferenceSettings& settings) {
    ContentHash hash;
    hash.add(std::string(k_tracer_version));
    hash.add_value(settings.bounces);
    hash.add_value(int(settings.diffuse_only || shot.diffuse_only));
    if (settings.diffuse_secondary && !settings.diffuse_only && !shot.diffuse_only)
        hash.add(std::string("diffuse_secondary"));
    if (shot.effective_model() != MaterialModel::plain) hash.add_value(int(shot.effective_model()) + 0x100);
    hash.add_value(settings.occlusion_distance);
    if (settings.occlusion_falloff != OcclusionFalloff::none) hash.add_value(int(settings.occlusion_falloff));
    hash.add_value(settings.roulette_depth);
    hash.add_value(int(settings.stratified));
    hash.add_value(settings.seed);
    hash.add_value(int(shot.normal_maps));
    hash.add_value(shot.width);
    hash.add_value(shot.height);
    add_camera(hash, state.camera);
    add_scene(hash, shot.scene);
    add_state(hash, state.scene);
    add_environment(hash, shot.environment);
    return hash.text();
}

} // namespace bounce
