#pragma once

#include <cstdint>

namespace bounce {

/// Bytes that may still be allocated on the current context's device: of main memory where the driver renders in
/// software, of the GPU's where the driver tells, else 2⁶⁴ − 1.
uint64_t available_device_memory();

} // namespace bounce
