// The scene at one time: node transforms, drawn instances, lights and cameras in world space.

#include "scene/keyframes.h"
#include "scene/scene.h"

namespace bounce {

namespace {

struct Transform {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
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
                local.translation = glm::dvec3(value);
                break;
            case AnimationTarget::rotation:
                local.rotation = glm::dquat(value.w, value.x, value.y, value.z);
                break;
            case AnimationTarget::scale:
                local.scale = glm::dvec3(value);
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

glm::dmat4 matrix_of(const Node& node, const Transform& local) {
    if (node.has_matrix) return node.matrix;
    glm::dmat3 linear = glm::mat3_cast(local.rotation);
    return glm::dmat4(glm::dvec4(linear[0] * local.scale.x, 0), glm::dvec4(linear[1] * local.scale.y, 0),
                      glm::dvec4(linear[2] * local.scale.z, 0), glm::dvec4(local.translation, 1));
}

/// The unit direction of one of a node's axes; scales of zero leave the axis as it is.
glm::vec3 world_axis(const glm::dmat4& world, const glm::dvec3& axis) {
    glm::dvec3 v = glm::dmat3(world) * axis;
    double length = glm::length(v);
    return glm::vec3(length > 0 ? v / length : axis);
}

std::vector<glm::mat4> loaded(const LoadedSpace& space, std::vector<glm::dmat4> worlds) {
    std::vector<glm::mat4> out;
    out.reserve(worlds.size());
    for (glm::dmat4& world : worlds) {
        world[3] -= glm::dvec4(space.origin, 0);
        for (int column = 0; column < 4; ++column)
            world[column] = glm::dvec4(glm::dvec3(world[column]) / space.unit, world[column].w);
        out.emplace_back(world);
    }
    return out;
}

} // namespace

std::vector<glm::dmat4> file_matrices(const Scene& scene, float time) {
    std::vector<Transform> locals = local_transforms(scene, time);
    std::vector<glm::dmat4> worlds(scene.nodes.size());
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        glm::dmat4 local = matrix_of(node, locals[i]);
        worlds[i] = node.parent < 0 ? local : worlds[size_t(node.parent)] * local;
    }
    return worlds;
}

std::vector<glm::mat4> world_matrices(const Scene& scene, float time) {
    return loaded(scene.space, file_matrices(scene, time));
}

SceneState evaluate_scene(const Scene& scene, float time, float previous_time) {
    const std::vector<glm::dmat4> in_file = file_matrices(scene, time);
    std::vector<glm::mat4> now = loaded(scene.space, in_file);
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
            light.direction = world_axis(in_file[i], {0, 0, -1});
            light.radius = float(light.radius / scene.space.unit);
            // Irradiance falls with the square of a distance that is told in another unit.
            if (light.type != LightType::directional)
                light.intensity = glm::vec3(glm::dvec3(light.intensity) / (scene.space.unit * scene.space.unit));
            state.lights.push_back(std::move(light));
        }
        if (node.camera >= 0) {
            Camera camera = scene.cameras[size_t(node.camera)];
            camera.near_plane = float(camera.near_plane / scene.space.unit);
            camera.position = glm::vec3(now[i][3]);
            camera.target = camera.position + world_axis(in_file[i], {0, 0, -1});
            camera.up = world_axis(in_file[i], {0, 1, 0});
            state.cameras.push_back(std::move(camera));
        }
    }
    return state;
}

} // namespace bounce
