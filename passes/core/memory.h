#pragma once
// How much memory is left, so that work that cannot fit is refused before it begins, with its numbers.

#include <cstdint>
#include <string>

namespace bounce {

/// Bytes that this process may still take: the least of what the machine has free, what its control group allows, and
/// what its own limit on addresses (ulimit -v) leaves.
uint64_t available_memory();

/// Throws Error "`what` needs about 25.3 GiB of memory, but 20.1 GiB are free: `remedy`" when `bytes` are more than
/// what is available.
void require_memory(double bytes, const std::string& what, const std::string& remedy);

} // namespace bounce
