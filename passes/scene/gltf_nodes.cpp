#include "core/error.h"
#include "core/limits.h"
#include "scene/gltf_parts.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

namespace bounce {

namespace {

class NodeReader {
  public:
    NodeReader(const GltfSource& source, Scene& scene) : source_(source), model_(source.model), scene_(scene) {}

    std::vector<int> read_all() {
        read_lights();
        read_cameras();
        std::vector<int> index(model_.nodes.size(), -1);
        // Breadth first from the roots: parents come before children, and no recursion meets a deep chain.
        std::vector<std::pair<int, int>> queue; // glTF node, parent in the scene
        for (int root : roots())
            queue.emplace_back(root, -1);
        for (size_t i = 0; i < queue.size(); ++i) {
            auto [from, parent] = queue[i];
            if (index[size_t(from)] >= 0) continue; // a root listed twice
            index[size_t(from)] = int(scene_.nodes.size());
            for (int child : model_.nodes[size_t(from)].children)
                queue.emplace_back(child, index[size_t(from)]);
            read(model_.nodes[size_t(from)], size_t(from), parent);
        }
        if (size_t outside = model_.nodes.size() - scene_.nodes.size())
            scene_.notes.push_back(fmt::format("{} node{} outside the file's scene {} left out", outside,
                                               outside == 1 ? "" : "s", outside == 1 ? "is" : "are"));
        return index;
    }

  private:
    std::vector<int> roots() {
        if (!model_.scenes.empty()) {
            size_t chosen = model_.defaultScene < 0 ? 0 : size_t(model_.defaultScene);
            if (model_.scenes.size() > 1)
                scene_.notes.push_back(
                    fmt::format("the file has {} scenes; scenes[{}] is read", model_.scenes.size(), chosen));
            return model_.scenes[chosen].nodes;
        }
        if (!model_.nodes.empty()) scene_.notes.push_back("the file has no scenes; all of its nodes are read");
        std::vector<bool> child(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes)
            for (int c : node.children)
                child[size_t(c)] = true;
        std::vector<int> out;
        for (size_t i = 0; i < child.size(); ++i)
            if (!child[i]) out.push_back(int(i));
        return out;
    }

    void read(const tinygltf::Node& from, size_t number, int parent) {
        Node node;
        node.name = from.name.empty() ? fmt::format("node {}", number) : from.name;
        node.parent = parent;
        node.mesh = from.mesh;
        node.camera = from.camera;
        if (node.mesh >= 0) instances_ += scene_.meshes[size_t(node.mesh)].primitives.size();
        if (instances_ > k_max_instances)
            throw Error(fmt::format("{}: the nodes draw more than {} primitives", source_.where(), k_max_instances));
        if (auto it = from.extensions.find("KHR_lights_punctual"); it != from.extensions.end())
            node.light = it->second.Get("light").GetNumberAsInt();
        if (from.matrix.size() == 16) {
            node.has_matrix = true;
            for (int i = 0; i < 16; ++i)
                glm::value_ptr(node.matrix)[i] = from.matrix[size_t(i)];
        }
        if (from.translation.size() == 3)
            node.translation = {from.translation[0], from.translation[1], from.translation[2]};
        if (from.scale.size() == 3) node.scale = {from.scale[0], from.scale[1], from.scale[2]};
        if (from.rotation.size() == 4) {
            glm::dquat q(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
            double length = glm::length(q);
            if (length > 0 && std::isfinite(length))
                node.rotation = q / length;
            else
                scene_.notes.push_back(fmt::format("nodes[{}].rotation has length 0 and is read as none", number));
        }
        scene_.nodes.push_back(std::move(node));
    }

    void read_lights() {
        for (size_t i = 0; i < model_.lights.size(); ++i) {
            const tinygltf::Light& from = model_.lights[i];
            Light light;
            light.name = from.name.empty() ? fmt::format("light {}", i) : from.name;
            if (from.type == "spot")
                light.type = LightType::spot;
            else if (from.type == "directional")
                light.type = LightType::directional;
            else if (from.type != "point")
                throw Error(fmt::format("{}: lights[{}].type '{}' is none of point, spot, directional", source_.where(),
                                        i, from.type.substr(0, 40)));
            glm::vec3 colour(1);
            if (from.color.size() == 3) colour = {float(from.color[0]), float(from.color[1]), float(from.color[2])};
            light.intensity = glm::max(colour * float(from.intensity), glm::vec3(0));
            if (!std::isfinite(light.intensity.r + light.intensity.g + light.intensity.b))
                throw Error(fmt::format("{}: invalid lights[{}].intensity {:g}: expected a product with color that a "
                                        "float holds",
                                        source_.where(), i, from.intensity));
            light.inner_cone = float(from.spot.innerConeAngle);
            light.outer_cone = float(from.spot.outerConeAngle);
            if (light.type == LightType::spot) check_cone(light, i);
            ranges_ += from.range > 0;
            scene_.lights.push_back(std::move(light));
        }
        if (ranges_)
            scene_.notes.push_back(fmt::format("the range of {} light{} is ignored", ranges_, ranges_ == 1 ? "" : "s"));
    }

    void check_cone(Light& light, size_t number) {
        if (!(light.outer_cone > 0) || light.outer_cone > glm::radians(90.001f) || light.inner_cone < 0)
            throw Error(
                fmt::format("{}: lights[{}].spot: the cone angles must be 0 ≤ inner < outer ≤ π/2, but are {} and {}",
                            source_.where(), number, light.inner_cone, light.outer_cone));
        if (light.inner_cone < light.outer_cone) return;
        light.inner_cone = 0.999f * light.outer_cone;
        scene_.notes.push_back(
            fmt::format("lights[{}].spot: the inner cone is not inside the outer and is read as nearly "
                        "as wide",
                        number));
    }

    void read_cameras() {
        for (size_t i = 0; i < model_.cameras.size(); ++i) {
            const tinygltf::Camera& from = model_.cameras[i];
            Camera camera;
            camera.name = from.name.empty() ? fmt::format("camera {}", i) : from.name;
            if (from.type == "perspective" && from.perspective.yfov > 0 && from.perspective.yfov < 3.1)
                camera.vfov = float(from.perspective.yfov);
            else
                scene_.notes.push_back(
                    fmt::format("cameras[{}] {} and is read as a perspective one of {:.0f} degrees", i,
                                from.type == "perspective" ? "has an impossible yfov" : "is orthographic",
                                glm::degrees(camera.vfov)));
            // The near plane of an orthographic camera says nothing about a perspective one at its place.
            if (from.type == "perspective" && from.perspective.znear > 0)
                camera.near_plane = float(from.perspective.znear);
            scene_.cameras.push_back(std::move(camera));
        }
    }

    const GltfSource& source_;
    const tinygltf::Model& model_;
    Scene& scene_;
    size_t instances_ = 0;
    int ranges_ = 0;
};

} // namespace

std::vector<int> read_nodes(const GltfSource& source, Scene& scene) {
    return NodeReader(source, scene).read_all();
}

void mark_dynamic_nodes(Scene& scene) {
    for (Node& node : scene.nodes)
        node.dynamic = !node.path.empty();
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            scene.nodes[size_t(channel.node)].dynamic = true;
    for (Node& node : scene.nodes)
        if (node.parent >= 0 && scene.nodes[size_t(node.parent)].dynamic) node.dynamic = true;
}

} // namespace bounce
