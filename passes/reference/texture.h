#pragma once
// Textures as the reference reads them: level 0, bilinear (or nearest), sRGB decoded before filtering, as a GPU does.

#include "scene/scene.h"

#include <tbb/cache_aligned_allocator.h>

namespace bounce {

/// Where a bilinear read finds its four texels, and their weights. Textures of one layout can share it.
struct TextureTaps {
    uint32_t at[4];
    float weight[4];
};

class ReferenceTexture {
  public:
    ReferenceTexture() = default;
    /// Copies the texels. An image without pixels reads as white.
    explicit ReferenceTexture(const Texture& texture);

    /// RGBA at uv (v down, as glTF has it). Alpha is never sRGB.
    glm::vec4 sample(glm::vec2 uv) const { return sample(taps(uv)); }
    glm::vec4 sample(const TextureTaps& taps) const;
    float sample_alpha(glm::vec2 uv) const;
    TextureTaps taps(glm::vec2 uv) const;
    /// Asks for the texels ahead of their use: they are seldom in the cache.
    void prefetch(const TextureTaps& taps) const {
        __builtin_prefetch(texel(taps.at[0]));
        __builtin_prefetch(texel(taps.at[3]));
    }
    /// Whether the taps of one are those of the other.
    bool same_layout(const ReferenceTexture& other) const;
    /// The largest value of each channel over all texels.
    glm::vec4 largest() const;

  private:
    /// Texels lie in blocks of 4×4, a cache line each, so that the four of a read are usually near each other.
    uint32_t index(int x, int y) const {
        return (uint32_t(y >> 2) * blocks_ + uint32_t(x >> 2)) * 16 + uint32_t((y & 3) * 4 + (x & 3));
    }
    const uint8_t* texel(uint32_t at) const { return &texels_[size_t(at) * 4]; }

    int width_ = 1, height_ = 1;
    uint32_t blocks_ = 1; ///< in a row
    Wrap wrap_u_ = Wrap::repeat, wrap_v_ = Wrap::repeat;
    bool nearest_ = false;
    const float* colour_ = nullptr; ///< a table of 256: sRGB or linear
    std::vector<uint8_t, tbb::cache_aligned_allocator<uint8_t>> texels_;
};

/// Texture coordinates as the slot reads them: offset + R(rotation)·(scale·uv), KHR_texture_transform.
struct SlotTransform {
    bool identity = true;
    int uv_set = 0;
    glm::vec2 x{1, 0}, y{0, 1}, offset{0};
    SlotTransform() = default;
    explicit SlotTransform(const TextureSlot& slot);
    bool same(const SlotTransform& other) const {
        return uv_set == other.uv_set && x == other.x && y == other.y && offset == other.offset;
    }
    glm::vec2 apply(const glm::vec2& uv) const {
        return identity ? uv : offset + glm::vec2(glm::dot(x, uv), glm::dot(y, uv));
    }
};

} // namespace bounce
