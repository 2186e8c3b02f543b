#pragma once
// How much memory the device has left, and what it means that there is none.

#include "core/error.h"

#include <cstdint>

namespace bounce {

struct DeviceMemory {
    uint64_t free = 0;    ///< bytes that may still be allocated; 2⁶⁴ − 1 where the driver does not tell
    bool is_main = false; ///< it is main memory: the driver renders in software
};

/// Of the current context's device: of main memory where the driver renders in software, of the GPU's where the driver
/// tells (GL_NVX_gpu_memory_info, GL_ATI_meminfo). A GPU's driver may move what is not in use to main memory, so that
/// more than that may be had.
DeviceMemory device_memory();
/// The bytes of it.
inline uint64_t available_device_memory() {
    return device_memory().free;
}

/// The driver had no memory for a texture or a buffer.
class OutOfDeviceMemory : public Error {
  public:
    using Error::Error;
};

/// Takes all errors that OpenGL has noted. True when one of them tells that memory ran out. Ends also where the context
/// is lost and every call tells of it.
bool drop_errors();

} // namespace bounce
