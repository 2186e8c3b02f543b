#pragma once
// Small glTF scenes made of quads, written to a folder, and shots that look at them.

#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

/// Diffuse quads; each has a colour of its own.
class TinyScene {
  public:
    /// Corners in order around; the normal is (b − a) × (c − a).
    TinyScene& quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec3 colour = glm::vec3(0.5f)) {
        quads_.push_back({{a, b, c, d}, colour});
        return *this;
    }
    TinyScene& emission(glm::vec3 radiance) {
        quads_.back().emission = radiance;
        return *this;
    }
    /// A box without a top and bottom missing: all six sides, facing outward.
    TinyScene& box(glm::vec3 low, glm::vec3 high, glm::vec3 colour = glm::vec3(0.5f)) {
        glm::vec3 l = low, h = high;
        quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z}, colour);
        quad({h.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, colour);
        quad({h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, colour);
        quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z}, colour);
        quad({l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z}, colour);
        quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z}, colour);
        return *this;
    }
    /// Everything times `s`.
    TinyScene scaled(float s) const {
        TinyScene out = *this;
        for (Quad& q : out.quads_)
            for (glm::vec3& corner : q.corners)
                corner *= s;
        return out;
    }

    /// Writes NAME.gltf and NAME.bin; returns the .gltf.
    std::filesystem::path write(const std::filesystem::path& folder, const std::string& name) const {
        std::vector<float> floats;
        std::string meshes, materials, nodes, accessors, views, roots;
        auto comma = [](std::string& list) { list += list.empty() ? "" : ","; };
        for (size_t i = 0; i < quads_.size(); ++i) {
            const Quad& q = quads_[i];
            glm::vec3 normal = glm::normalize(glm::cross(q.corners[1] - q.corners[0], q.corners[2] - q.corners[0]));
            size_t at = floats.size() * 4;
            glm::vec3 low(1e30f), high(-1e30f);
            for (int corner : {0, 1, 2, 0, 2, 3}) {
                const glm::vec3& p = q.corners[corner];
                low = glm::min(low, p), high = glm::max(high, p);
                floats.insert(floats.end(), {p.x, p.y, p.z});
            }
            for (int corner = 0; corner < 6; ++corner)
                floats.insert(floats.end(), {normal.x, normal.y, normal.z});
            for (std::string* list : {&meshes, &materials, &nodes, &roots})
                comma(*list);
            comma(accessors), comma(views);
            meshes += fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{}}},"material":{}}}]}})",
                                  2 * i, 2 * i + 1, i);
            materials += fmt::format(
                R"({{"pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},1],"metallicFactor":0,"roughnessFactor":1}},"emissiveFactor":[{},{},{}]}})",
                q.colour.r, q.colour.g, q.colour.b, q.emission.r, q.emission.g, q.emission.b);
            nodes += fmt::format(R"({{"mesh":{}}})", i);
            roots += std::to_string(i);
            accessors += fmt::format(
                R"({{"bufferView":{},"componentType":5126,"count":6,"type":"VEC3","min":[{},{},{}],"max":[{},{},{}]}},)"
                R"({{"bufferView":{},"componentType":5126,"count":6,"type":"VEC3"}})",
                2 * i, low.x, low.y, low.z, high.x, high.y, high.z, 2 * i + 1);
            views += fmt::format(
                R"({{"buffer":0,"byteOffset":{},"byteLength":72}},{{"buffer":0,"byteOffset":{},"byteLength":72}})", at,
                at + 72);
        }
        std::ofstream(folder / (name + ".bin"), std::ios::binary)
            .write(reinterpret_cast<const char*>(floats.data()), std::streamsize(floats.size() * 4));
        std::ofstream(folder / (name + ".gltf")) << fmt::format(
            R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],"meshes":[{}],)"
            R"("materials":[{}],"accessors":[{}],"bufferViews":[{}],)"
            R"("buffers":[{{"uri":"{}.bin","byteLength":{}}}]}})",
            roots, nodes, meshes, materials, accessors, views, name, floats.size() * 4);
        return folder / (name + ".gltf");
    }

  private:
    struct Quad {
        glm::vec3 corners[4];
        glm::vec3 colour;
        glm::vec3 emission{0};
    };
    std::vector<Quad> quads_;
};

inline std::string json_of(glm::vec3 v) {
    return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

/// Writes NAME.json with the camera and lights given as JSON; returns its path.
inline std::string write_shot(const std::filesystem::path& folder, const std::string& name, const std::string& scene,
                              glm::vec3 eye, glm::vec3 target, const std::string& lights,
                              const std::string& more = "") {
    std::filesystem::path file = folder / (name + ".json");
    std::ofstream(file) << fmt::format(
        R"({{"scene":"{}","width":64,"height":64,"diffuse_only":true,"lights_mode":"replace","lights":[{}],)"
        R"("camera":{{"position":{},"target":{},"vfov_deg":50}}{}}})",
        scene, lights, json_of(eye), json_of(target), more);
    return file.string();
}

} // namespace bounce
