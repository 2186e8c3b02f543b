#include "scene/quad_scene.h"

#include "core/image.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace bounce {

using nlohmann::json;

namespace {

json numbers(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

/// Appends to the binary part; returns where it begins.
size_t append(std::string& bytes, const std::vector<glm::vec3>& values) {
    const size_t at = bytes.size();
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(glm::vec3));
    return at;
}

} // namespace

QuadScene& QuadScene::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec3 colour) {
    quads_.push_back({{a, b, c, d}, {colour, glm::vec3(0), 1, 0}});
    return *this;
}

QuadScene& QuadScene::box(glm::vec3 l, glm::vec3 h, glm::vec3 colour) {
    quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z}, colour);
    quad({h.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, colour);
    quad({h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, colour);
    quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z}, colour);
    quad({l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z}, colour);
    return quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z}, colour);
}

QuadScene& QuadScene::emission(glm::vec3 radiance) {
    quads_.back().look.emission = radiance;
    return *this;
}

QuadScene& QuadScene::look(size_t first, const Look& look) {
    for (size_t i = first; i < quads_.size(); ++i)
        quads_[i].look = look;
    return *this;
}

QuadScene& QuadScene::instance(size_t first, size_t count, const glm::mat4& to_world) {
    for (size_t i = first; i < first + count; ++i)
        instances_.push_back({i, to_world});
    return *this;
}

QuadScene& QuadScene::copy(size_t first, size_t count, const glm::mat4& to_world) {
    const bool mirrored = glm::determinant(glm::mat3(to_world)) < 0;
    for (size_t i = first; i < first + count; ++i) {
        Quad quad = quads_[i];
        for (glm::vec3& corner : quad.corners)
            corner = glm::vec3(to_world * glm::vec4(corner, 1));
        if (mirrored) std::swap(quad.corners[1], quad.corners[3]);
        quads_.push_back(quad);
    }
    return *this;
}

QuadScene QuadScene::scaled(float s) const {
    QuadScene out = *this;
    for (Quad& quad : out.quads_)
        for (glm::vec3& corner : quad.corners)
            corner *= s;
    return out;
}

QuadScene QuadScene::reversed() const {
    QuadScene out = *this;
    std::reverse(out.quads_.begin(), out.quads_.end());
    for (Instance& instance : out.instances_)
        instance.quad = quads_.size() - 1 - instance.quad;
    return out;
}

std::filesystem::path QuadScene::write(const std::filesystem::path& folder, const std::string& name) const {
    std::string bytes;
    json meshes = json::array(), materials = json::array(), nodes = json::array(), accessors = json::array();
    json views = json::array(), roots = json::array();
    const auto accessor = [&](const std::vector<glm::vec3>& values) {
        glm::vec3 low(values.front()), high(values.front());
        for (const glm::vec3& v : values)
            low = glm::min(low, v), high = glm::max(high, v);
        const size_t at = append(bytes, values);
        views.push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes.size() - at}});
        accessors.push_back({{"bufferView", views.size() - 1},
                             {"componentType", 5126},
                             {"count", values.size()},
                             {"type", "VEC3"},
                             {"min", numbers(low)},
                             {"max", numbers(high)}});
        return accessors.size() - 1;
    };
    for (const Quad& q : quads_) {
        const glm::vec3* c = q.corners;
        const glm::vec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
        const size_t positions = accessor({c[0], c[1], c[2], c[0], c[2], c[3]});
        const size_t normals = accessor(std::vector<glm::vec3>(6, normal));
        materials.push_back({{"pbrMetallicRoughness",
                              {{"baseColorFactor", {q.look.colour.r, q.look.colour.g, q.look.colour.b, 1}},
                               {"metallicFactor", q.look.metallic},
                               {"roughnessFactor", q.look.roughness}}},
                             {"emissiveFactor", numbers(q.look.emission)}});
        meshes.push_back(
            {{"primitives",
              {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"material", materials.size() - 1}}}}});
        nodes.push_back({{"mesh", meshes.size() - 1}});
    }
    for (const Instance& instance : instances_) {
        json matrix = json::array();
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                matrix.push_back(instance.to_world[column][row]);
        nodes.push_back({{"mesh", instance.quad}, {"matrix", matrix}});
    }
    for (size_t i = 0; i < nodes.size(); ++i)
        roots.push_back(i);
    const json gltf = {{"asset", {{"version", "2.0"}}},
                       {"scene", 0},
                       {"scenes", {{{"nodes", roots}}}},
                       {"nodes", nodes},
                       {"meshes", meshes},
                       {"materials", materials},
                       {"accessors", accessors},
                       {"bufferViews", views},
                       {"buffers", {{{"uri", name + ".bin"}, {"byteLength", bytes.size()}}}}};
    write_file_atomically(folder / (name + ".bin"), bytes);
    write_file_atomically(folder / (name + ".gltf"), gltf.dump());
    return folder / (name + ".gltf");
}

} // namespace bounce
