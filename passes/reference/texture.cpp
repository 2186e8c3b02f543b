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
    : width_(texture.image.width), height_(texture.image.height), wrap_u_(texture.wrap_u), wrap_v_(texture.wrap_v),
      nearest_(texture.nearest), colour_(texture.srgb ? tables().srgb.data() : tables().linear.data()),
      texels_(texture.image.rgba) {
    if (width_ <= 0 || height_ <= 0 || texels_.size() != size_t(width_) * size_t(height_) * 4) {
        width_ = height_ = 1;
        texels_.assign(4, 255);
    }
}

/// A coordinate brought into [0,1] by its wrap mode; what is not finite becomes 0.
static float wrapped(float t, Wrap mode) {
    if (mode == Wrap::repeat)
        t -= std::floor(t);
    else if (mode == Wrap::mirrored_repeat) {
        t -= 2 * std::floor(0.5f * t);
        if (t > 1) t = 2 - t;
    } else
        t = std::clamp(t, 0.0f, 1.0f);
    return t >= 0 && t <= 1 ? t : 0.0f;
}

/// The two texels along one axis, and the weight of the second.
static void axis_taps(float t, int size, Wrap mode, int& first, int& second, float& fraction) {
    float at = wrapped(t, mode) * float(size) - 0.5f;
    float below = std::floor(at);
    fraction = at - below;
    first = int(below);
    second = first + 1;
    if (mode == Wrap::repeat) {
        if (first < 0) first += size;
        if (second >= size) second -= size;
    }
    first = std::clamp(first, 0, size - 1);
    second = std::clamp(second, 0, size - 1);
}

ReferenceTexture::Taps ReferenceTexture::taps(glm::vec2 uv) const {
    Taps t;
    if (nearest_) {
        t.x0 = t.x1 = std::min(width_ - 1, int(wrapped(uv.x, wrap_u_) * float(width_)));
        t.y0 = t.y1 = std::min(height_ - 1, int(wrapped(uv.y, wrap_v_) * float(height_)));
        t.fx = t.fy = 0;
        return t;
    }
    axis_taps(uv.x, width_, wrap_u_, t.x0, t.x1, t.fx);
    axis_taps(uv.y, height_, wrap_v_, t.y0, t.y1, t.fy);
    return t;
}

glm::vec4 ReferenceTexture::sample(glm::vec2 uv) const {
    const Taps t = taps(uv);
    glm::vec4 top = decode(texel(t.x0, t.y0)) * (1 - t.fx) + decode(texel(t.x1, t.y0)) * t.fx;
    glm::vec4 bottom = decode(texel(t.x0, t.y1)) * (1 - t.fx) + decode(texel(t.x1, t.y1)) * t.fx;
    return top * (1 - t.fy) + bottom * t.fy;
}

float ReferenceTexture::sample_alpha(glm::vec2 uv) const {
    const Taps t = taps(uv);
    float top = float(texel(t.x0, t.y0)[3]) * (1 - t.fx) + float(texel(t.x1, t.y0)[3]) * t.fx;
    float bottom = float(texel(t.x0, t.y1)[3]) * (1 - t.fx) + float(texel(t.x1, t.y1)[3]) * t.fx;
    return (top * (1 - t.fy) + bottom * t.fy) * (1.0f / 255);
}

glm::vec4 ReferenceTexture::largest() const {
    uint8_t most[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < texels_.size(); ++i)
        most[i & 3] = std::max(most[i & 3], texels_[i]);
    return decode(most);
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
