#pragma once
// Scenes made in memory that tests of several techniques look at.

#include "support/scene_runner.h"

namespace bounce {

/// Floor, a floating slab, a block on the floor, a tilted board.
inline Scene blocks() {
    return MadeScene()
        .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, {0.8f, 0.4f, 0.2f})
        .box({-0.9f, 0.7f, -0.6f}, {-0.2f, 0.75f, 0.5f}, {0.2f, 0.6f, 0.4f})
        .box({0.3f, 0, -0.9f}, {0.8f, 0.5f, -0.4f}, {0.3f, 0.3f, 0.7f})
        .quad({-1.2f, 0.1f, 1.2f}, {0.1f, 0.2f, 1.4f}, {0.1f, 0.9f, 0.9f}, {-1.2f, 0.8f, 0.7f}, {0.7f, 0.7f, 0.1f})
        .scene;
}

/// A quad whose alpha passes its cutoff at x = 0: transparent to the left.
inline Scene half_transparent(bool by_texture) {
    MadeScene made;
    made.quad({-1, -0.8f, -0.9f}, {1, -0.6f, -0.7f}, {1, 0.3f, 0.9f}, {-1, 0.1f, 0.7f});
    made.material().alpha_mode = AlphaMode::mask;
    for (size_t k = 0; k < 4; ++k) {
        Vertex& vertex = made.vertex(k);
        bool right = k == 1 || k == 2;
        vertex.u0 = right ? 1.0f : 0.0f;
        vertex.v0 = k >= 2 ? 1.0f : 0.0f;
        if (!by_texture && !right) vertex.colour_ba = 0x0000ffffu; // alpha 0, blue 1
    }
    if (by_texture) {
        Texture& texture = made.scene.textures.emplace_back();
        texture.image = {64, 64, std::vector<uint8_t>(64 * 64 * 4, 255)};
        for (size_t i = 0; i < 64 * 64; ++i)
            texture.image.rgba[4 * i + 3] = i % 64 < 32 ? 0 : 255;
        // A repeated texture would blend its two halves at the quad's own rims too.
        texture.wrap_u = texture.wrap_v = Wrap::clamp_to_edge;
        made.material().base_colour_texture.texture = 0;
    }
    return made.scene;
}

} // namespace bounce
