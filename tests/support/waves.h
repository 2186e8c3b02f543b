#pragma once
// A scene of as many triangles as wanted, for benchmarks.

#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <cmath>

namespace bounce {

/// A wavy plane of 2·side² triangles in one mesh, and a shot that looks at it; returns the shot's path.
inline std::string waves(const TempFolder& folder, int side) {
    std::vector<glm::vec3> corners;
    auto at = [&](int x, int z) {
        glm::vec2 p = 2.0f * glm::vec2(x, z) / float(side) - 1.0f;
        return glm::vec3(p.x, 0.1f * std::sin(9 * p.x) * std::cos(7 * p.y), p.y);
    };
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x)
            corners.insert(corners.end(),
                           {at(x, z + 1), at(x + 1, z + 1), at(x + 1, z), at(x, z + 1), at(x + 1, z), at(x, z)});
    std::ofstream(folder / "waves.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(corners.data()), std::streamsize(corners.size() * sizeof(glm::vec3)));
    folder.write(
        "waves.gltf",
        fmt::format(
            R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"accessors":[{{"bufferView":0,)"
            R"("componentType":5126,"count":{},"type":"VEC3","min":[-1,-0.1,-1],"max":[1,0.1,1]}}],)"
            R"("bufferViews":[{{"buffer":0,"byteLength":{}}}],"buffers":[{{"uri":"waves.bin","byteLength":{}}}]}})",
            corners.size(), corners.size() * 12, corners.size() * 12));
    return write_shot(folder.path(), "waves", "waves.gltf", {0, 1.5f, 2}, {0, 0, 0},
                      R"({"type":"directional","direction":[0.3,-1,0.2],"intensity":3})");
}

} // namespace bounce
