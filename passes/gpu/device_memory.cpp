#include "gpu/device_memory.h"

#include "core/memory.h"
#include "gpu/driver_limits.h"

#include <cstring>
#include <limits>

namespace bounce {

DeviceMemory device_memory() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const char* software : {"llvmpipe", "softpipe", "lavapipe", "SwiftShader"})
        if (renderer && std::strstr(renderer, software)) return {available_memory(), true};
    constexpr GLenum k_nvidia_available_kib = 0x9049, k_ati_texture_free_kib = 0x87FC;
    GLint kib[4] = {0, 0, 0, 0};
    if (driver_has("GL_NVX_gpu_memory_info"))
        glGetIntegerv(k_nvidia_available_kib, kib);
    else if (driver_has("GL_ATI_meminfo"))
        glGetIntegerv(k_ati_texture_free_kib, kib);
    return {kib[0] > 0 ? uint64_t(kib[0]) * 1024 : std::numeric_limits<uint64_t>::max(), false};
}

bool drop_errors() {
    bool out_of_memory = false;
    constexpr int k_most = 64; // a driver notes each kind of error once, or a few times
    for (int i = 0; i < k_most; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR || error == GL_CONTEXT_LOST) break;
        out_of_memory = out_of_memory || error == GL_OUT_OF_MEMORY;
    }
    return out_of_memory;
}

} // namespace bounce
