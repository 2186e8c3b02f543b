#include "gpu/objects.h"

#include "core/error.h"
#include "core/text.h"
#include "gpu/device_memory.h"

#include <fmt/format.h>

namespace bounce {

Buffer::Buffer(uint64_t bytes, const void* data, const std::string& name, GLbitfield flags) : bytes_(bytes) {
    drop_errors();
    glCreateBuffers(1, &id_);
    // A buffer of no bytes is an error in OpenGL; an empty list still has to be bindable.
    glNamedBufferStorage(id_, GLsizeiptr(bytes ? bytes : 16), bytes ? data : nullptr, flags);
    ++live_objects().buffers;
    if (GLenum error = glGetError(); error != GL_NO_ERROR) {
        destroy();
        const std::string text =
            fmt::format("buffer '{}' of {} could not be allocated", name, format_bytes(double(bytes)));
        if (error == GL_OUT_OF_MEMORY) throw OutOfDeviceMemory(text + " (out of memory)");
        throw Error(text + fmt::format(" (GL error {:#x})", error));
    }
    glObjectLabel(GL_BUFFER, id_, -1, name.c_str());
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    id_ = std::exchange(other.id_, 0);
    bytes_ = std::exchange(other.bytes_, 0);
    return *this;
}

void Buffer::destroy() {
    if (!id_) return;
    glDeleteBuffers(1, &id_);
    id_ = 0;
    --live_objects().buffers;
}

void Buffer::update(uint64_t offset, uint64_t bytes, const void* data) const {
    if (bytes) glNamedBufferSubData(id_, GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::clear(uint32_t value) const {
    // OpenGL clears whole elements only: an odd length is cleared byte by byte (to the value's lowest one).
    bool whole = bytes_ % 4 == 0;
    glClearNamedBufferData(id_, whole ? GL_R32UI : GL_R8UI, GL_RED_INTEGER, whole ? GL_UNSIGNED_INT : GL_UNSIGNED_BYTE,
                           &value);
}

void Buffer::read(uint64_t offset, uint64_t bytes, void* out) const {
    if (bytes) glGetNamedBufferSubData(id_, GLintptr(offset), GLsizeiptr(bytes), out);
}

static void attach(GLuint framebuffer, GLenum point, const Attachment& attachment) {
    const GpuTexture& texture = *attachment.texture;
    if (attachment.layer >= 0 && texture.desc().kind != TextureKind::texture_2d) {
        glNamedFramebufferTextureLayer(framebuffer, point, texture.id(), attachment.mip, attachment.layer);
    } else {
        glNamedFramebufferTexture(framebuffer, point, texture.id(), attachment.mip);
    }
}

Framebuffer::Framebuffer(const std::vector<Attachment>& colours, Attachment depth, const std::string& name,
                         glm::ivec2 size) {
    glCreateFramebuffers(1, &id_);
    ++live_objects().framebuffers;
    glObjectLabel(GL_FRAMEBUFFER, id_, -1, name.c_str());
    std::vector<GLenum> buffers;
    for (size_t i = 0; i < colours.size(); ++i) {
        GLenum point = GLenum(GL_COLOR_ATTACHMENT0 + i);
        attach(id_, point, colours[i]);
        buffers.push_back(point);
    }
    glNamedFramebufferDrawBuffers(id_, GLsizei(buffers.size()), buffers.data());
    if (depth.texture) attach(id_, GL_DEPTH_ATTACHMENT, depth);
    if (colours.empty() && !depth.texture) {
        glNamedFramebufferParameteri(id_, GL_FRAMEBUFFER_DEFAULT_WIDTH, size.x);
        glNamedFramebufferParameteri(id_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, size.y);
    }
    GLenum status = glCheckNamedFramebufferStatus(id_, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        destroy();
        throw Error(fmt::format("framebuffer '{}' is incomplete (status {:#x}): its attachments do not go together",
                                name, status));
    }
}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    id_ = std::exchange(other.id_, 0);
    return *this;
}

void Framebuffer::destroy() {
    if (!id_) return;
    glDeleteFramebuffers(1, &id_);
    id_ = 0;
    --live_objects().framebuffers;
}

Sampler::Sampler(GLenum min_filter, GLenum mag_filter, GLenum wrap, const std::string& name, float anisotropy) {
    glCreateSamplers(1, &id_);
    ++live_objects().samplers;
    glObjectLabel(GL_SAMPLER, id_, -1, name.c_str());
    glSamplerParameteri(id_, GL_TEXTURE_MIN_FILTER, GLint(min_filter));
    glSamplerParameteri(id_, GL_TEXTURE_MAG_FILTER, GLint(mag_filter));
    glSamplerParameteri(id_, GL_TEXTURE_WRAP_R, GLint(wrap));
    glSamplerParameterf(id_, GL_TEXTURE_MAX_ANISOTROPY, anisotropy);
    set_wrap(wrap, wrap);
}

void Sampler::set_wrap(GLenum u, GLenum v) const {
    glSamplerParameteri(id_, GL_TEXTURE_WRAP_S, GLint(u));
    glSamplerParameteri(id_, GL_TEXTURE_WRAP_T, GLint(v));
}

Sampler& Sampler::operator=(Sampler&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    id_ = std::exchange(other.id_, 0);
    return *this;
}

void Sampler::destroy() {
    if (!id_) return;
    glDeleteSamplers(1, &id_);
    id_ = 0;
    --live_objects().samplers;
}

VertexArray::VertexArray(const std::string& name) {
    glCreateVertexArrays(1, &id_);
    ++live_objects().vertex_arrays;
    glObjectLabel(GL_VERTEX_ARRAY, id_, -1, name.c_str());
}

VertexArray& VertexArray::operator=(VertexArray&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    id_ = std::exchange(other.id_, 0);
    return *this;
}

void VertexArray::destroy() {
    if (!id_) return;
    glDeleteVertexArrays(1, &id_);
    id_ = 0;
    --live_objects().vertex_arrays;
}

} // namespace bounce
