// The scene at one time: node transforms, drawn instances, lights and cameras in world space.

#include "scene/keyframes.h"
#include "scene/scene.h"

namespace bounce {

namespace {

struct Transform {
    glm::vec3 translation;
    glm::quat rotation;
    glm::vec3 scale;
};

std::vector<Transform> local_transforms(const Scene& scene, float time) {
    std::vector<Transform> out;
    out.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes)
        out.push_back({node.translation, node.rotation, node.scale});
    for (const Animation& animation : scene.animations) {
        float t = loop_time(animation, time);
        for (const AnimationChannel& channel : animation.channels) {
            Transform& local = out[size_t(channel.node)];
            glm::vec4 value = sample_channel(channel, t);
            switch (channel.target) {
            case AnimationTarget::translation:
                local.translation = value;
                break;
            case AnimationTarget::rotation:
                local.rotation = glm::quat(value.w, value.x, value.y, value.z);
                break;
            case AnimationTarget::scale:
                local.scale = value;
                break;
            }
        }
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.path.empty()) continue;
        PathKey key = node.path.at(time);
        out[i].translation = key.position;
        if (key.has_target)
            out[i].rotation = look_rotation(key.target - key.position, node.light >= 0 || node.camera >= 0);
    }
    return out;
}

glm::mat4 matrix_of(const Node& node, const Transform& local) {
    if (node.has_matrix) return node.matrix;
    glm::mat3 linear = glm::mat3_cast(local.rotation);
    return glm::mat4(glm::vec4(linear[0] * local.scale.x, 0), glm::vec4(linear[1] * local.scale.y, 0),
                     glm::vec4(linear[2] * local.scale.z, 0), glm::vec4(local.translation, 1));
}

/// The unit direction of one of a node's axes; scales of zero leave the axis as it is.
glm::vec3 world_axis(const glm::mat4& world, const glm::vec3& axis) {
    glm::vec3 v = glm::mat3(world) * axis;
    float length = glm::length(v);
    return length > 0 ? v / length : axis;
}

} // namespace

std::vector<glm::mat4> world_matrices(const Scene& scene, float time) {
    std::vector<Transform> locals = local_transforms(scene, time);
    std::vector<glm::mat4> worlds(scene.nodes.size());
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        glm::mat4 local = matrix_of(node, locals[i]);
        worlds[i] = node.parent < 0 ? local : worlds[size_t(node.parent)] * local;
    }
    return worlds;
}

SceneState evaluate_scene(const Scene& scene, float time, float previous_time) {
    std::vector<glm::mat4> now = world_matrices(scene, time);
    std::vector<glm::mat4> before = previous_time == time ? now : world_matrices(scene, previous_time);
    SceneState state;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh >= 0)
            for (const Primitive& primitive : scene.meshes[size_t(node.mesh)].primitives)
                state.instances.push_back({now[i], before[i], primitive, int(i), node.dynamic});
        if (node.light >= 0 && scene.lights[size_t(node.light)].enabled) {
            Light light = scene.lights[size_t(node.light)];
            light.position = glm::vec3(now[i][3]);
            light.direction = world_axis(now[i], {0, 0, -1});
            state.lights.push_back(std::move(light));
        }
        if (node.camera >= 0) {
            Camera camera = scene.cameras[size_t(node.camera)];
            camera.position = glm::vec3(now[i][3]);
            camera.target = camera.position + world_axis(now[i], {0, 0, -1});
            camera.up = world_axis(now[i], {0, 1, 0});
            state.cameras.push_back(std::move(camera));
        }
    }
    return state;
}

} // namespace bounce
