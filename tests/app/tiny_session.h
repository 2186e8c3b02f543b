#pragma once
// A session over a floor with a box and a lamp, small enough to be opened many times.
#include "app/session.h"
#include "support/tiny_scene.h"

#include <filesystem>

namespace bounce {

/// Writes the scene and its shot into `root`.
inline SessionOptions tiny_session(const std::filesystem::path& root) {
    TinyScene()
        .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1})
        .box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f})
        .write(root, "tiny");
    SessionOptions out;
    out.shot = write_shot(root, "tiny", "tiny.gltf", {0.4f, 1, 2}, {0, 0.2f, 0},
                          R"({"type":"point","position":[-0.7,1,0.4],"intensity":2})");
    out.size = {32, 18};
    out.sets = {{"shadow_maps.resolution", "64"}};
    return out;
}

} // namespace bounce
