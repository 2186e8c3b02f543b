#pragma once
// Textures as the reference reads them: level 0, bilinear (or nearest), sRGB decoded before filtering, as a GPU does.

#include "scene/scene.h"

namespace bounce {

class ReferenceTexture {
  public:
    ReferenceTexture() = default;
    /// Copies the texels. An image without pixels reads as white.
    explicit ReferenceTexture(const Texture& texture);

    /// RGBA at uv (v down, as glTF has it). Alpha is never sRGB.
    glm::vec4 sample(glm::vec2 uv) const;
    float sample_alpha(glm::vec2 uv) const;
    /// The largest value of each channel over all texels.
    glm::vec4 largest() const;
    glm::ivec2 size() const { return {width_, height_}; }

  private:
    struct Taps {
        int x0, x1, y0, y1;
        float fx, fy;
    };
    Taps taps(glm::vec2 uv) const;
    const uint8_t* texel(int x, int y) const { return &texels_[(size_t(y) * size_t(width_) + size_t(x)) * 4]; }
    glm::vec4 decode(const uint8_t* t) const {
        return {colour_[t[0]], colour_[t[1]], colour_[t[2]], float(t[3]) * (1.0f / 255)};
    }

    int width_ = 0, height_ = 0;
    Wrap wrap_u_ = Wrap::repeat, wrap_v_ = Wrap::repeat;
    bool nearest_ = false;
    const float* colour_ = nullptr; ///< a table of 256: sRGB or linear
    std::vector<uint8_t> texels_;
};

/// Texture coordinates as the slot reads them: offset + R(rotation)·(scale·uv), KHR_texture_transform.
struct SlotTransform {
    bool identity = true;
    int uv_set = 0;
    glm::vec2 x{1, 0}, y{0, 1}, offset{0};
    SlotTransform() = default;
    explicit SlotTransform(const TextureSlot& slot);
    glm::vec2 apply(const glm::vec2& uv) const {
        return identity ? uv : offset + glm::vec2(glm::dot(x, uv), glm::dot(y, uv));
    }
};

} // namespace bounce
