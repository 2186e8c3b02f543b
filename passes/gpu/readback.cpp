#include "gpu/readback.h"

#include <cstring>

namespace bounce {

Readback::~Readback() {
    if (fence_) glDeleteSync(fence_);
}

void Readback::request(const Buffer& source) {
    if (fence_ || !source || !source.bytes()) return;
    if (staging_.bytes() != source.bytes()) {
        GLbitfield flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        staging_ = Buffer(source.bytes(), nullptr, "readback", flags | GL_CLIENT_STORAGE_BIT);
        mapped_ = glMapNamedBufferRange(staging_.id(), 0, GLsizeiptr(source.bytes()), flags);
    }
    if (!mapped_) return;
    glCopyNamedBufferSubData(source.id(), staging_.id(), 0, 0, GLsizeiptr(source.bytes()));
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush(); // so that it is signalled even when nothing else is drawn
}

bool Readback::arrived() {
    if (!fence_) return false;
    GLenum state = glClientWaitSync(fence_, 0, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return false;
    glDeleteSync(fence_);
    fence_ = nullptr;
    data_.resize(staging_.bytes());
    std::memcpy(data_.data(), mapped_, data_.size());
    return true;
}

} // namespace bounce
