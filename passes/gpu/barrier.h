#pragma once
// The only place that calls glMemoryBarrier.

#include <glad/gl.h>
#include <string>

namespace bounce {

/// What comes later waits for the stores of shaders before, as far as it reaches memory by the routes of these bits;
/// its own stores wait for reads (OpenGL 4.6, §7.13.2; the rules that hazard_check.h holds the program to).
void memory_barrier(GLbitfield bits);

/// "GL_TEXTURE_FETCH_BARRIER_BIT|…" without the affixes: "texture_fetch|shader_image_access".
std::string barrier_text(GLbitfield bits);

} // namespace bounce
