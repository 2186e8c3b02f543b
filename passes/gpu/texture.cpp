#include "core/error.h"
#include "core/text.h"
#include "gpu/device_memory.h"
#include "gpu/driver_limits.h"
#include "gpu/objects.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

LiveObjects& live_objects() {
    static LiveObjects counts;
    return counts;
}

GLenum gl_target(TextureKind kind) {
    switch (kind) {
    case TextureKind::texture_2d:
        return GL_TEXTURE_2D;
    case TextureKind::texture_2d_array:
        return GL_TEXTURE_2D_ARRAY;
    case TextureKind::texture_3d:
        return GL_TEXTURE_3D;
    }
    return 0;
}

glm::ivec3 mip_size(const TextureDesc& desc, int mip) {
    glm::ivec3 size(std::max(1, desc.size.x >> mip), std::max(1, desc.size.y >> mip), desc.size.z);
    if (desc.kind == TextureKind::texture_3d) size.z = std::max(1, desc.size.z >> mip);
    return size;
}

int full_mip_count(const TextureDesc& desc) {
    int longest = std::max(desc.size.x, desc.size.y);
    if (desc.kind == TextureKind::texture_3d) longest = std::max(longest, desc.size.z);
    int mips = 1;
    while (longest >>= 1)
        ++mips;
    return mips;
}

uint64_t texture_bytes(const TextureDesc& desc) {
    uint64_t bytes = 0;
    for (int mip = 0; mip < desc.mips; ++mip) {
        glm::ivec3 size = mip_size(desc, mip);
        bytes += uint64_t(size.x) * size.y * size.z * format_by_enum(desc.format).bytes;
    }
    return bytes;
}

static void check_size(const TextureDesc& desc, const std::string& name) {
    glm::ivec3 s = desc.size;
    bool is_3d = desc.kind == TextureKind::texture_3d;
    int64_t side = driver_limit(is_3d ? GL_MAX_3D_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE);
    int64_t depth = is_3d                                        ? side
                    : desc.kind == TextureKind::texture_2d_array ? driver_limit(GL_MAX_ARRAY_TEXTURE_LAYERS)
                                                                 : 1;
    bool fits = s.x >= 1 && s.y >= 1 && s.z >= 1 && s.x <= side && s.y <= side && s.z <= depth;
    if (!fits) {
        throw Error(fmt::format("texture '{}' would be {}×{}×{}; this driver allows 1 … {} by {} by {}", name, s.x, s.y,
                                s.z, side, side, depth));
    }
    if (desc.mips < 1 || desc.mips > full_mip_count(desc)) {
        throw Error(fmt::format("texture '{}' of {}×{}×{} has 1 … {} mips, not {}", name, s.x, s.y, s.z,
                                full_mip_count(desc), desc.mips));
    }
}

GpuTexture::GpuTexture(const TextureDesc& desc, const std::string& name) : desc_(desc), name_(name) {
    check_size(desc, name);
    drop_errors();
    glCreateTextures(gl_target(desc.kind), 1, &id_);
    if (desc.kind == TextureKind::texture_2d) {
        glTextureStorage2D(id_, desc.mips, desc.format, desc.size.x, desc.size.y);
    } else {
        glTextureStorage3D(id_, desc.mips, desc.format, desc.size.x, desc.size.y, desc.size.z);
    }
    ++live_objects().textures;
    if (GLenum error = glGetError(); error != GL_NO_ERROR) {
        destroy();
        const std::string text =
            fmt::format("texture '{}' of {} could not be allocated", name, format_bytes(double(texture_bytes(desc))));
        if (error == GL_OUT_OF_MEMORY) throw OutOfDeviceMemory(text + " (out of memory)");
        throw Error(text + fmt::format(" (GL error {:#x})", error));
    }
    glObjectLabel(GL_TEXTURE, id_, -1, name.c_str());
    GLenum filter = format_by_enum(desc.format).is_integer() ? GL_NEAREST : GL_LINEAR;
    glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER,
                        desc.mips == 1         ? filter
                        : filter == GL_NEAREST ? GL_NEAREST_MIPMAP_NEAREST
                                               : GL_LINEAR_MIPMAP_LINEAR);
    for (GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(id_, wrap, GL_CLAMP_TO_EDGE);
    }
}

GpuTexture& GpuTexture::operator=(GpuTexture&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    id_ = std::exchange(other.id_, 0);
    is_view_ = other.is_view_;
    desc_ = other.desc_;
    name_ = std::move(other.name_);
    return *this;
}

void GpuTexture::destroy() {
    if (!id_) return;
    glDeleteTextures(1, &id_);
    id_ = 0;
    --(is_view_ ? live_objects().views : live_objects().textures);
}

void GpuTexture::clear(glm::vec4 value, int mip) const {
    const Format& format = format_by_enum(desc_.format);
    int first = mip < 0 ? 0 : mip, last = mip < 0 ? desc_.mips - 1 : mip;
    glm::ivec4 integers(value);
    glm::uvec4 naturals(value);
    const void* data = format.clear_type == GL_FLOAT ? static_cast<const void*>(&value)
                       : format.clear_type == GL_INT ? static_cast<const void*>(&integers)
                                                     : static_cast<const void*>(&naturals);
    for (int level = first; level <= last; ++level) {
        glClearTexImage(id_, level, format.transfer, format.clear_type, data);
    }
}

GpuTexture GpuTexture::view(TextureKind kind, int first_mip, int mips, int first_layer, int layers,
                            GLenum format) const {
    GpuTexture result;
    result.is_view_ = true;
    glm::ivec3 size = mip_size(desc_, first_mip);
    if (desc_.kind == TextureKind::texture_2d_array) size.z = layers;
    result.desc_ = {kind, format ? format : desc_.format, size, mips};
    result.name_ = name_ + " (view)";
    glGenTextures(1, &result.id_);
    glTextureView(result.id_, gl_target(kind), id_, result.desc_.format, first_mip, mips, first_layer, layers);
    ++live_objects().views;
    glObjectLabel(GL_TEXTURE, result.id_, -1, result.name_.c_str());
    GLenum filter = format_by_enum(desc_.format).is_integer() ? GL_NEAREST : GL_LINEAR;
    glTextureParameteri(result.id_, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(result.id_, GL_TEXTURE_MIN_FILTER,
                        mips == 1              ? filter
                        : filter == GL_NEAREST ? GL_NEAREST_MIPMAP_NEAREST
                                               : GL_LINEAR_MIPMAP_LINEAR);
    for (GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(result.id_, wrap, GL_CLAMP_TO_EDGE);
    }
    return result;
}

template <typename T>
static std::vector<T> read_texture(const GpuTexture& texture, int mip, GLenum type) {
    const TextureDesc& desc = texture.desc();
    const Format& format = format_by_enum(desc.format);
    glm::ivec3 size = mip_size(desc, mip);
    std::vector<T> values(size_t(size.x) * size.y * size.z * format.channels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.id(), mip, format.transfer, type, GLsizei(values.size() * sizeof(T)), values.data());
    return values;
}

std::vector<float> GpuTexture::read(int mip) const {
    const Format& format = format_by_enum(desc_.format);
    if (!format.is_integer()) return read_texture<float>(*this, mip, GL_FLOAT);
    std::vector<uint32_t> integers = read_integers(mip);
    std::vector<float> values(integers.size());
    bool is_signed = format.kind == FormatClass::signed_integer;
    std::transform(integers.begin(), integers.end(), values.begin(),
                   [&](uint32_t v) { return is_signed ? float(int32_t(v)) : float(v); });
    return values;
}

std::vector<uint32_t> GpuTexture::read_integers(int mip) const {
    bool is_signed = format_by_enum(desc_.format).kind == FormatClass::signed_integer;
    return read_texture<uint32_t>(*this, mip, is_signed ? GL_INT : GL_UNSIGNED_INT);
}

} // namespace bounce
