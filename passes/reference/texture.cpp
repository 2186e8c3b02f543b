#include "reference/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bounce {

namespace {
struct Tables {
    std::array<float, 256> srgb, linear;
    Tables() {
        for (int i = 0; i < 256; ++i) {
            linear[size_t(i)] = float(i) / 255;
            srgb[size_t(i)] = srgb_decode(float(i) / 255);
        }
    }
};
} // namespace

static const Tables& tables() {
    static const Tables made;
    return made;
}

ReferenceTexture::ReferenceTexture(const Texture& texture)
    : wrap_u_(texture.wrap_u), wrap_v_(texture.wrap_v), nearest_(texture.nearest),
      colour_(texture.srgb ? tables().srgb.data() : tables().linear.data()) {
    const Image8& image = texture.image;
    if (image.width <= 0 || image.height <= 0 || image.rgba.size() != size_t(image.width) * size_t(image.height) * 4) {
        texels_.assign(64, 255);
        return;
    }
    width_ = image.width;
    height_ = image.height;
    blocks_ = uint32_t(width_ + 3) / 4;
    texels_.resize(size_t(blocks_) * size_t((height_ + 3) / 4) * 64);
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            std::copy_n(&image.rgba[(size_t(y) * size_t(width_) + size_t(x)) * 4], 4,
                        &texels_[size_t(index(x, y)) * 4]);
        }
    }
}

bool ReferenceTexture::same_layout(const ReferenceTexture& other) const {
    return width_ == other.width_ && height_ == other.height_ && wrap_u_ == other.wrap_u_ && wrap_v_ == other.wrap_v_ &&
           nearest_ == other.nearest_;
}

/// Rounded down, without a library call; for |t| < 2³¹.
static int floor_int(float t) {
    const int i = int(t);
    return i - (float(i) > t);
}

/// A coordinate brought into [0,1] by its wrap mode; what is huge or not finite becomes 0.
static float wrapped(float t, Wrap mode) {
    if (!(std::abs(t) < 1e6f)) return 0;
    if (mode == Wrap::repeat) return t - float(floor_int(t));
    if (mode == Wrap::clamp_to_edge) return std::clamp(t, 0.0f, 1.0f);
    t -= 2 * float(floor_int(0.5f * t));
    return t > 1 ? 2 - t : t;
}

/// The two texels along one axis, and the weight of the second.
static void axis_taps(float t, int size, Wrap mode, int& first, int& second, float& fraction) {
    const float at = wrapped(t, mode) * float(size) - 0.5f;
    first = floor_int(at);
    fraction = at - float(first);
    second = first + 1;
    if (mode == Wrap::repeat) {
        if (first < 0) first += size;
        if (second >= size) second -= size;
    }
    first = std::clamp(first, 0, size - 1);
    second = std::clamp(second, 0, size - 1);
}

TextureTaps ReferenceTexture::taps(glm::vec2 uv) const {
    int x0, x1, y0, y1;
    float fx = 0, fy = 0;
    if (nearest_) {
        x0 = x1 = std::min(width_ - 1, int(wrapped(uv.x, wrap_u_) * float(width_)));
        y0 = y1 = std::min(height_ - 1, int(wrapped(uv.y, wrap_v_) * float(height_)));
    } else {
        axis_taps(uv.x, width_, wrap_u_, x0, x1, fx);
        axis_taps(uv.y, height_, wrap_v_, y0, y1, fy);
    }
    return {{index(x0, y0), index(x1, y0), index(x0, y1), index(x1, y1)},
            {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

glm::vec4 ReferenceTexture::sample(const TextureTaps& taps) const {
    glm::vec4 sum(0);
    for (int i = 0; i < 4; ++i) {
        const uint8_t* t = texel(taps.at[i]);
        sum += taps.weight[i] * glm::vec4(colour_[t[0]], colour_[t[1]], colour_[t[2]], float(t[3]) * (1.0f / 255));
    }
    return sum;
}

float ReferenceTexture::sample_alpha(glm::vec2 uv) const {
    const TextureTaps t = taps(uv);
    float sum = 0;
    for (int i = 0; i < 4; ++i)
        sum += t.weight[i] * float(texel(t.at[i])[3]);
    return sum * (1.0f / 255);
}

glm::vec4 ReferenceTexture::largest() const {
    uint8_t most[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < texels_.size(); ++i)
        most[i & 3] = std::max(most[i & 3], texels_[i]);
    return {colour_[most[0]], colour_[most[1]], colour_[most[2]], float(most[3]) * (1.0f / 255)};
}

SlotTransform::SlotTransform(const TextureSlot& slot) : uv_set(slot.uv_set) {
    identity = slot.offset == glm::vec2(0) && slot.scale == glm::vec2(1) && slot.rotation == 0;
    // KHR_texture_transform: rotation turns uv counter-clockwise as seen in texture space with v down.
    float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
    x = glm::vec2(c * slot.scale.x, s * slot.scale.y);
    y = glm::vec2(-s * slot.scale.x, c * slot.scale.y);
    offset = slot.offset;
}

} // namespace bounce
