#pragma once
// OpenGL objects: move-only, immutable storage, made by direct state access, named for debuggers at birth.

#include "gpu/format.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

/// How many objects of ours live, for leak tests and the window.
struct LiveObjects {
    int textures = 0, views = 0, buffers = 0, framebuffers = 0, samplers = 0, vertex_arrays = 0, programs = 0,
        queries = 0;
    int total() const {
        return textures + views + buffers + framebuffers + samplers + vertex_arrays + programs + queries;
    }
};
LiveObjects& live_objects();

enum class TextureKind { texture_2d, texture_2d_array, texture_3d };
GLenum gl_target(TextureKind kind);

/// width × height × depth; depth = slices of a 3D texture or layers of an array (1 for 2D).
struct TextureDesc {
    TextureKind kind = TextureKind::texture_2d;
    GLenum format = GL_RGBA16F;
    glm::ivec3 size{1};
    int mips = 1;
    bool operator==(const TextureDesc&) const = default;
};
/// Bytes of all mips.
uint64_t texture_bytes(const TextureDesc& desc);
/// Size of one mip level (layers of an array are kept).
glm::ivec3 mip_size(const TextureDesc& desc, int mip);
/// Mips of a full chain.
int full_mip_count(const TextureDesc& desc);

class GpuTexture {
  public:
    GpuTexture() = default;
    /// Throws Error when the size exceeds the driver's limits or memory runs out.
    GpuTexture(const TextureDesc& desc, const std::string& name);
    ~GpuTexture() { destroy(); }
    GpuTexture(GpuTexture&& other) noexcept { *this = std::move(other); }
    GpuTexture& operator=(GpuTexture&& other) noexcept;

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    const TextureDesc& desc() const { return desc_; }
    const std::string& name() const { return name_; }

    /// Fills one mip (or all, mip = −1) with a value, converted to the format's class.
    void clear(glm::vec4 value, int mip = -1) const;
    /// A view of some mips and layers, of the same or another kind (a layer of an array as a 2D texture). 3D textures
    /// have no layer views. `format` 0 keeps the format.
    GpuTexture view(TextureKind kind, int first_mip, int mips, int first_layer, int layers, GLenum format = 0) const;

    /// Reads one mip back as floats (`channels` of the format, layers one after another). Stalls.
    std::vector<float> read(int mip = 0) const;
    std::vector<uint32_t> read_integers(int mip = 0) const;

  private:
    void destroy();
    GLuint id_ = 0;
    bool is_view_ = false;
    TextureDesc desc_;
    std::string name_;
};

class Buffer {
  public:
    Buffer() = default;
    /// `data` may be null (contents undefined). Immutable; `flags` are glNamedBufferStorage's (default: updatable).
    Buffer(uint64_t bytes, const void* data, const std::string& name, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT);
    ~Buffer() { destroy(); }
    Buffer(Buffer&& other) noexcept { *this = std::move(other); }
    Buffer& operator=(Buffer&& other) noexcept;

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    uint64_t bytes() const { return bytes_; }
    void update(uint64_t offset, uint64_t bytes, const void* data) const;
    void clear(uint32_t value = 0) const;
    void read(uint64_t offset, uint64_t bytes, void* out) const;
    template <typename T>
    std::vector<T> read_all() const {
        std::vector<T> values(bytes_ / sizeof(T));
        read(0, values.size() * sizeof(T), values.data());
        return values;
    }

  private:
    void destroy();
    GLuint id_ = 0;
    uint64_t bytes_ = 0;
};

/// One attachment: a texture's mip, and one layer of it or all (layer −1: layered rendering).
struct Attachment {
    const GpuTexture* texture = nullptr;
    int mip = 0;
    int layer = -1;
};

class Framebuffer {
  public:
    Framebuffer() = default;
    /// Throws Error when incomplete. `depth.texture` may be null. With no attachments at all, `size` is its default
    /// size.
    Framebuffer(const std::vector<Attachment>& colours, Attachment depth, const std::string& name,
                glm::ivec2 size = {0, 0});
    ~Framebuffer() { destroy(); }
    Framebuffer(Framebuffer&& other) noexcept { *this = std::move(other); }
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

  private:
    void destroy();
    GLuint id_ = 0;
};

class Sampler {
  public:
    Sampler() = default;
    Sampler(GLenum min_filter, GLenum mag_filter, GLenum wrap, const std::string& name, float anisotropy = 1);
    ~Sampler() { destroy(); }
    Sampler(Sampler&& other) noexcept { *this = std::move(other); }
    Sampler& operator=(Sampler&& other) noexcept;
    GLuint id() const { return id_; }
    void set_wrap(GLenum u, GLenum v) const;

  private:
    void destroy();
    GLuint id_ = 0;
};

class VertexArray {
  public:
    VertexArray() = default;
    explicit VertexArray(const std::string& name);
    ~VertexArray() { destroy(); }
    VertexArray(VertexArray&& other) noexcept { *this = std::move(other); }
    VertexArray& operator=(VertexArray&& other) noexcept;
    GLuint id() const { return id_; }

  private:
    void destroy();
    GLuint id_ = 0;
};

} // namespace bounce
