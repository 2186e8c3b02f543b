#include "app/ui/texel.h"

#include <cmath>
#include <fmt/format.h>

namespace bounce {

/// Significant decimals for the mantissa that a format has.
static int digits_of(const Format& format) {
    if (format.kind == FormatClass::normalised) return format.bytes / format.channels >= 2 ? 6 : 4;
    if (format.kind != FormatClass::floating) return 0;
    if (format.internal == GL_R11F_G11F_B10F) return 4;
    return format.bytes / format.channels == 2 ? 5 : 0;
}

Texel read_texel(const GpuTexture& texture, int mip, glm::ivec3 at, float scale) {
    const Format& format = format_by_enum(texture.desc().format);
    at = glm::clamp(at, glm::ivec3(0), mip_size(texture.desc(), mip) - 1);
    Texel texel;
    texel.channels = format.channels;
    texel.integer = format.is_integer();
    texel.digits = digits_of(format);
    auto read = [&](GLenum type, auto& values) {
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glGetTextureSubImage(texture.id(), mip, at.x, at.y, at.z, 1, 1, 1, format.transfer, type,
                             GLsizei(sizeof values), values.data());
    };
    if (format.kind == FormatClass::unsigned_integer) {
        std::array<uint32_t, 4> values{};
        read(GL_UNSIGNED_INT, values);
        std::copy(values.begin(), values.end(), texel.whole.begin());
    } else if (format.kind == FormatClass::signed_integer) {
        std::array<int32_t, 4> values{};
        read(GL_INT, values);
        std::copy(values.begin(), values.end(), texel.whole.begin());
    } else {
        read(GL_FLOAT, texel.real);
        for (size_t c = 0; c < 3; ++c)
            texel.real[c] *= scale;
    }
    return texel;
}

std::string to_text(const Texel& texel) {
    std::string text;
    for (size_t i = 0; i < size_t(texel.channels); ++i) {
        if (i) text += ", ";
        if (texel.integer)
            text += fmt::format("{}", texel.whole[i]);
        else if (texel.digits)
            text += fmt::format("{:.{}g}", texel.real[i], texel.digits);
        else
            text += fmt::format("{}", texel.real[i]);
    }
    return text;
}

bool is_finite(const Texel& texel) {
    for (size_t i = 0; i < size_t(texel.channels); ++i) {
        if (!texel.integer && !std::isfinite(texel.real[i])) return false;
    }
    return true;
}

glm::ivec2 texel_at(glm::vec2 place, glm::ivec2 size) {
    return glm::clamp(glm::ivec2(glm::floor(place * glm::vec2(size))), glm::ivec2(0), size - 1);
}

std::optional<glm::vec3> world_position(const FrameConstants& c, glm::ivec2 pixel, float depth) {
    if (!(depth > 0)) return std::nullopt;
    glm::vec2 plane = (glm::vec2(pixel) + 0.5f) / glm::vec2(c.resolution) * 2.0f - 1.0f;
    glm::vec3 ray = c.camera_forward + c.tan_half_vfov * (plane.x * c.aspect * c.camera_right - plane.y * c.camera_up);
    return c.camera_position + ray * (c.near_plane / depth);
}

} // namespace bounce
