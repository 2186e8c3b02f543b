#include "gpu/barrier.h"

#include "core/text.h"

#include <utility>
#include <vector>

namespace bounce {

void memory_barrier(GLbitfield bits) {
    glMemoryBarrier(bits);
}

std::string barrier_text(GLbitfield bits) {
    static const std::pair<GLbitfield, const char*> names[] = {
        {GL_TEXTURE_FETCH_BARRIER_BIT, "texture_fetch"},
        {GL_SHADER_IMAGE_ACCESS_BARRIER_BIT, "shader_image_access"},
        {GL_SHADER_STORAGE_BARRIER_BIT, "shader_storage"},
        {GL_FRAMEBUFFER_BARRIER_BIT, "framebuffer"},
        {GL_COMMAND_BARRIER_BIT, "command"},
        {GL_TEXTURE_UPDATE_BARRIER_BIT, "texture_update"},
        {GL_BUFFER_UPDATE_BARRIER_BIT, "buffer_update"},
    };
    if (bits == GL_ALL_BARRIER_BITS) return "all";
    std::vector<std::string> set;
    for (const auto& [bit, name] : names) {
        if (bits & bit) set.push_back(name);
    }
    return join(set, "|");
}

} // namespace bounce
