#include "gpu/device_memory.h"

#include "core/memory.h"

#include <cstring>
#include <glad/gl.h>
#include <limits>
#include <string_view>

namespace bounce {

static bool has_extension(std::string_view wanted) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (wanted == reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i)))) return true;
    return false;
}

uint64_t available_device_memory() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const char* software : {"llvmpipe", "softpipe", "lavapipe", "SwiftShader"})
        if (renderer && std::strstr(renderer, software)) return available_memory();
    constexpr GLenum k_nvidia_available_kib = 0x9049, k_ati_texture_free_kib = 0x87FC;
    GLint kib[4] = {0, 0, 0, 0};
    if (has_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(k_nvidia_available_kib, kib);
    else if (has_extension("GL_ATI_meminfo"))
        glGetIntegerv(k_ati_texture_free_kib, kib);
    return kib[0] > 0 ? uint64_t(kib[0]) * 1024 : std::numeric_limits<uint64_t>::max();
}

} // namespace bounce
