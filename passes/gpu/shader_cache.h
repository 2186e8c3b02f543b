#pragma once
// Mesa keeps compiled shaders in a folder, and maps the index of it into memory. Where the disk is full, a write to a
// part of the index that has no place on the disk yet ends the program with SIGBUS.

#include <cstdint>
#include <filesystem>

namespace bounce {

/// Where Mesa would keep them; empty when it is told not to.
std::filesystem::path shader_cache_folder();

/// Bytes that must be free there: the index (1.3 MB), and some shaders.
constexpr uint64_t k_least_cache_space = uint64_t(16) << 20;

/// Turns the cache off for this program, with a warning, where too little is free for it. Call before the first EGL or
/// GLFW call. Returns whether the cache stays on.
bool guard_shader_cache();

/// Once a context has been made: gives the whole index its place on the disk, so that a disk that fills up later does
/// no harm.
void settle_shader_cache();

} // namespace bounce
