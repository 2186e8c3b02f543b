// From scene data to the Embree scene.

#include "core/error.h"
#include "reference/geometry.h"
#include "scene/loaded_space.h"
#include "scene/normal_transform.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace bounce {

TraceGeometry::TraceGeometry(const Shot& shot, const SceneState& state, bool diffuse_only) {
    const Scene& scene = shot.scene;
    textures_.reserve(scene.textures.size());
    for (const Texture& texture : scene.textures)
        textures_.emplace_back(texture);
    for (const Material& material : scene.materials)
        add_material(material, shot.normal_maps);
    if (diffuse_only) {
        // Roughness only shapes the microfacet lobe, which is then not used; its texture need not be read for it, but
        // metalness still takes from the diffuse colour.
        for (TraceMaterial& material : materials_)
            material.roughness = 1;
    }
    geometries_.reserve(state.instances.size());
    for (const Instance& instance : state.instances)
        add_geometry(scene, instance);
    if (!bounds_.empty() && bounds_.diagonal() == 0) {
        const glm::dvec3 at = scene.space.to_file(bounds_.min);
        throw Error(fmt::format("invalid geometry: all triangles lie in one point ({:g}, {:g}, {:g}), as far as floats "
                                "can tell: expected triangles with an area",
                                at.x, at.y, at.z));
    }
    build();
}

TraceGeometry::~TraceGeometry() {
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
}

TraceGeometry::TextureUse TraceGeometry::texture_use(const TextureSlot& slot) const {
    TextureUse use;
    if (slot.texture < 0 || size_t(slot.texture) >= textures_.size()) return use;
    use.texture = &textures_[size_t(slot.texture)];
    use.transform = SlotTransform(slot);
    use.transform.uv_set = std::clamp(use.transform.uv_set, 0, 1);
    return use;
}

void TraceGeometry::add_material(const Material& material, bool normal_maps) {
    TraceMaterial out;
    out.base_colour = material.base_colour;
    out.emission = material.emission;
    out.metallic = material.metallic;
    out.roughness = material.roughness;
    out.normal_scale = material.normal_scale;
    out.alpha_cutoff = material.alpha_cutoff;
    out.alpha_mode = material.alpha_mode;
    blended_ = blended_ || material.alpha_mode == AlphaMode::blend;
    out.emissive = material.is_emissive();
    out.base_colour_texture = texture_use(material.base_colour_texture);
    out.metallic_roughness_texture = texture_use(material.metallic_roughness_texture);
    if (normal_maps) out.normal_texture = texture_use(material.normal_texture);
    out.emission_texture = texture_use(material.emission_texture);
    auto shared = [&](const TextureUse& use) {
        const TextureUse& base = out.base_colour_texture;
        return use.texture && base.texture && use.texture->same_layout(*base.texture) &&
               use.transform.same(base.transform);
    };
    out.shared_metallic_roughness = shared(out.metallic_roughness_texture);
    out.shared_normal = shared(out.normal_texture);
    materials_.push_back(out);
}

/// Embree leaves out what lies beyond its range, and ends the program on what is not finite.
static void check_vertex(const Scene& scene, const Instance& instance, uint32_t vertex, const glm::vec3& position) {
    const bool inside =
        std::abs(position.x) <= k_farthest && std::abs(position.y) <= k_farthest && std::abs(position.z) <= k_farthest;
    if (inside) return;
    throw Error(fmt::format("invalid vertex {} of node '{}' at ({:g}, {:g}, {:g}): expected coordinates within {:g}, "
                            "beyond which no rays can be traced",
                            vertex, scene.nodes[size_t(instance.node)].name.substr(0, 60), position.x, position.y,
                            position.z, k_farthest));
}

void TraceGeometry::add_geometry(const Scene& scene, const Instance& instance) {
    const Primitive& primitive = instance.primitive;
    Geometry geometry;
    geometry.material = primitive.material;
    if (primitive.material < 0 || size_t(primitive.material) >= materials_.size()) {
        throw Error(fmt::format("the scene's primitive at index {} names material {}, but there are {}",
                                primitive.first_index, primitive.material, materials_.size()));
    }
    const size_t first = primitive.first_index, count = primitive.index_count / 3 * 3;
    if (first + count > scene.indices.size()) throw Error("a primitive of the scene names indices beyond its last one");

    const glm::mat3 linear(instance.world);
    const NormalTransform turn(instance.world);
    geometry.mirrored = turn.mirrored;
    auto unit = [](const glm::vec3& v) {
        float length = glm::length(v);
        return length > 0 && length < 1e30f ? v / length : glm::vec3(0);
    };

    uint32_t lowest = ~0u, highest = 0;
    for (size_t i = first; i < first + count; ++i) {
        lowest = std::min(lowest, scene.indices[i]);
        highest = std::max(highest, scene.indices[i]);
    }
    if (count && highest >= scene.vertices.size())
        throw Error("a primitive of the scene names a vertex beyond its last one");
    if (count) geometry.vertices.assign(scene.vertices.begin() + lowest, scene.vertices.begin() + highest + 1);
    for (Vertex& vertex : geometry.vertices) {
        vertex.position = glm::vec3(instance.world * glm::vec4(vertex.position, 1));
        vertex.normal = unit(turn.matrix * vertex.normal);
        vertex.tangent = glm::vec4(unit(linear * glm::vec3(vertex.tangent)), vertex.tangent.w);
        if (vertex.colour_rg != 0xffffffffu || vertex.colour_ba != 0xffffffffu) geometry.vertex_colours = true;
    }
    geometry.indices.reserve(count);
    for (size_t i = first; i < first + count; ++i) {
        geometry.indices.push_back(scene.indices[i] - lowest);
        const glm::vec3& position = geometry.vertices[geometry.indices.back()].position;
        check_vertex(scene, instance, scene.indices[i], position);
        bounds_.add(position);
    }
    geometries_.push_back(std::move(geometry));
}

void TraceGeometry::build() {
    device_ = rtcNewDevice(nullptr);
    if (!device_)
        throw Error(fmt::format("Embree cannot start on this processor (error {})", int(rtcGetDeviceError(nullptr))));
    scene_ = rtcNewScene(device_);
    // Robust: rays do not slip between neighbouring triangles, so a closed box is closed.
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    filter_data_.resize(geometries_.size());
    for (size_t i = 0; i < geometries_.size(); ++i) {
        const Geometry& geometry = geometries_[i];
        filter_data_[i] = {this, &geometry};
        RTCGeometry embree = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        if (!geometry.indices.empty()) {
            rtcSetSharedGeometryBuffer(embree, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, geometry.vertices.data(),
                                       0, sizeof(Vertex), geometry.vertices.size());
            rtcSetSharedGeometryBuffer(embree, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, geometry.indices.data(), 0,
                                       3 * sizeof(uint32_t), geometry.triangle_count());
        }
        if (materials_[size_t(geometry.material)].alpha_mode != AlphaMode::opaque) {
            rtcSetGeometryUserData(embree, &filter_data_[i]);
            rtcSetGeometryIntersectFilterFunction(embree, &TraceGeometry::filter);
            rtcSetGeometryOccludedFilterFunction(embree, &TraceGeometry::filter);
        }
        rtcCommitGeometry(embree);
        rtcAttachGeometryByID(scene_, embree, unsigned(i));
        rtcReleaseGeometry(embree);
    }
    // Parallel builds order leaves by chance; one thread makes the tree a function of the scene alone.
    tbb::task_arena alone(1);
    alone.execute([this] { rtcJoinCommitScene(scene_); });
    if (RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE) {
        throw Error(fmt::format("Embree could not build the scene (error {}{})", int(error),
                                error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : ""));
    }
}

} // namespace bounce
