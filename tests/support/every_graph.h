#pragma once
// For tests of every graph: their names, and a shot of something of everything that a graph may ask for.
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

inline std::vector<std::string> graph_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(real_root() / "assets/graphs"))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

inline std::string tiny_shot(const TempFolder& folder) {
    TinyScene()
        .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.7f, 0.6f, 0.5f})
        .box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f}, {0.4f, 0.5f, 0.8f})
        .quad({-0.8f, 0.01f, 0.6f}, {-0.5f, 0.01f, 0.6f}, {-0.5f, 0.3f, 0.5f}, {-0.8f, 0.3f, 0.5f})
        .emission({0.9f, 0.8f, 0.3f})
        .write(folder.path(), "tiny");
    return write_shot(
        folder.path(), "tiny", "tiny.gltf", {0.4f, 1, 2}, {0, 0.2f, 0},
        R"({"type":"spot","position":[0.5,2,0.5],"direction":[-0.2,-1,-0.2],"intensity":4,"outer_cone_deg":40},)"
        R"({"type":"point","position":[-0.7,1,0.4],"intensity":2},)"
        R"({"type":"directional","direction":[0.3,-1,-0.2],"intensity":1})",
        R"(,"environment":[0.2,0.3,0.4])");
}

} // namespace bounce
