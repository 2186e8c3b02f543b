#pragma once
// What a shader asks of the driver's limits, read from its expanded text before anything is compiled. Counted is what
// the functions that main reaches name, branches aside that constants rule out, and every block: no driver counts more,
// some count less (they see through more). No OpenGL calls.

#include "gpu/shader_source.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

struct ShaderNeeds {
    ShaderStage stage = ShaderStage::compute;
    std::vector<std::string> samplers, images;               ///< by name, each element of an array
    std::vector<std::string> storage_blocks, uniform_blocks; ///< by name
    int64_t uniform_components = 0;                          ///< words of the uniforms outside of blocks
    int64_t uniform_block_bytes = 0;                         ///< of the largest
    int64_t shared_bytes = 0;                                ///< of a compute shader; three components as four
    glm::ivec3 local_size{1};                                ///< of a compute shader
    int64_t outputs = 0;                                     ///< of a fragment shader: colours that it writes
    int64_t output_vertices = 0;                             ///< of a geometry shader
    bool layer_from_vertex = false;                          ///< a vertex shader writes gl_Layer or gl_ViewportIndex
};

/// Of the expanded text of a stage. Text that is no GLSL needs what can be followed of it.
ShaderNeeds shader_needs(const std::string& text, ShaderStage stage);

} // namespace bounce
