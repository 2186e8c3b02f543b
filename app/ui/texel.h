#pragma once
// Exact values of single texels, and where a pixel is in the world.

#include "gpu/objects.h"
#include "gpu_scene/frame_constants.h"

#include <array>
#include <optional>
#include <string>

namespace bounce {

/// One texel as its format has it: integers as integers, everything else as floats.
struct Texel {
    int channels = 0;
    bool integer = false;
    int digits = 0; ///< that tell the format's values apart; 0: as many as a float needs
    std::array<float, 4> real{};
    std::array<int64_t, 4> whole{};
};

/// Reads back one texel and nothing more (x, y, layer or slice), clamped to the mip's size; the first three channels of
/// floats are multiplied by `scale` (Session::value_scale). Stalls.
Texel read_texel(const GpuTexture& texture, int mip, glm::ivec3 at, float scale = 1);

/// "0.25, 1, 0.1": decimals short enough to read and long enough to tell any two values of the format apart; "nan",
/// "inf".
std::string to_text(const Texel& texel);
bool is_finite(const Texel& texel);

/// The texel of a mip's size under a place in [0,1)², row 0 at the top.
glm::ivec2 texel_at(glm::vec2 place, glm::ivec2 size);

/// World position of a pixel's surface from its reversed depth; nothing for the background. glsl/lib/frame.glsl has the
/// same.
std::optional<glm::vec3> world_position(const FrameConstants& constants, glm::ivec2 pixel, float depth);

} // namespace bounce
