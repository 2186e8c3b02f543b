#pragma once
// What a shader's text says of the images and storage blocks that it declares, which OpenGL cannot be asked for:
// readonly, writeonly, coherent, and an image's format. No OpenGL calls.

#include <glad/gl.h>
#include <map>
#include <string>

namespace bounce {

struct ShaderMemory {
    bool reads = true, writes = true; ///< both unless it says readonly or writeonly
    bool coherent = false;            ///< or volatile
    GLenum format = 0;                ///< of an image that states one that Bounce uses; 0 else
    bool is_image = false;
};

/// By name: of a storage block the block's. Of text that is no GLSL, what can be followed.
std::map<std::string, ShaderMemory> read_shader_memory(const std::string& text);

} // namespace bounce
