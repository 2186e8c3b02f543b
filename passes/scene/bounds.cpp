#include "scene/motion.h"
#include "scene/scene.h"

namespace bounce {

void Bounds::add(const glm::vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
}

void Bounds::add(const Bounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
}

static void add_primitive(const Scene& scene, const Primitive& primitive, const glm::mat4& world, Bounds& bounds) {
    for (uint32_t i = 0; i < primitive.index_count; ++i)
        bounds.add(world_point(world, scene.vertices[scene.indices[primitive.first_index + i]].position));
}

Bounds scene_bounds(const Scene& scene, float time) {
    Bounds bounds;
    std::vector<glm::mat4> worlds = world_matrices(scene, time);
    for (size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].mesh >= 0)
            for (const Primitive& primitive : scene.meshes[size_t(scene.nodes[i].mesh)].primitives)
                add_primitive(scene, primitive, worlds[i], bounds);
    return bounds;
}

Bounds scene_bounds_over_animation(const Scene& scene) {
    Bounds bounds;
    std::vector<Mover> movers;
    std::vector<glm::mat4> start = world_matrices(scene, 0);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : scene.meshes[size_t(node.mesh)].primitives) {
            auto first = scene.indices.begin() + primitive.first_index;
            if (node.dynamic)
                movers.push_back({i, points_of(scene, {first, first + primitive.index_count})});
            else
                add_primitive(scene, primitive, start[i], bounds);
        }
    }
    if (!movers.empty()) visit_motion(scene, movers, [&](size_t, const Bounds& box, size_t) { bounds.add(box); });
    return bounds;
}

} // namespace bounce
