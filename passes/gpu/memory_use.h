#pragma once
// Which memory a command of OpenGL reads and writes, and by which route. No OpenGL calls.

#include <cstdint>
#include <glad/gl.h>
#include <string>
#include <vector>

namespace bounce {

/// How a command reaches memory. Each route has its own bit of glMemoryBarrier (OpenGL 4.6, §7.13.2).
enum class MemoryRoute {
    sampler,
    image,
    storage,
    uniform,
    vertices,
    indices,
    indirect,
    framebuffer,
    texture_transfer, ///< uploads, copies, clears and read-backs of textures
    buffer_transfer,  ///< the same of buffers, and mapping
};
GLbitfield barrier_bit(MemoryRoute route);
const char* to_string(MemoryRoute route);

/// A texture's mips and layers (slices of a volume), or a buffer's bytes. Ends are excluded.
struct MemoryRange {
    GLuint object = 0;
    bool is_buffer = false;
    int first_mip = 0, end_mip = 1;
    int64_t begin = 0, end = 1;

    bool overlaps(const MemoryRange& other) const {
        return object == other.object && is_buffer == other.is_buffer && first_mip < other.end_mip &&
               other.first_mip < end_mip && begin < other.end && other.begin < end;
    }
    bool contains(const MemoryRange& other) const {
        return object == other.object && is_buffer == other.is_buffer && first_mip <= other.first_mip &&
               other.end_mip <= end_mip && begin <= other.begin && other.end <= end;
    }
    bool operator==(const MemoryRange&) const = default;
};

struct MemoryUse {
    MemoryRange range;
    MemoryRoute route = MemoryRoute::sampler;
    bool reads = false, writes = false;
    std::string name; ///< in the shader; empty for what no shader names

    /// What OpenGL does not order by itself: the stores of shaders.
    bool stores() const { return writes && (route == MemoryRoute::image || route == MemoryRoute::storage); }
    bool by_shader() const { return route <= MemoryRoute::indices; }
    bool operator==(const MemoryUse&) const = default;
};

/// A dispatch, draw, copy, clear, upload or read-back.
struct MemoryCommand {
    std::string place; ///< "pass 'gather', dispatch of dvs/gather.comp"
    std::vector<MemoryUse> uses;
};

} // namespace bounce
