#pragma once
// Small scenes of quads, and shots that look at them.

#include "scene/quad_scene.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <glm/glm.hpp>
#include <string>

namespace bounce {

using TinyScene = QuadScene;

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
