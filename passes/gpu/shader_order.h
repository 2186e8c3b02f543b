#pragma once
// Holds a shader's text to what it declares of the order of its invocations. Within a dispatch or draw nothing orders
// the plain stores of one invocation with the loads of another, but `coherent` memory with a memoryBarrier between the
// two (OpenGL 4.6, §7.13.1). A driver cannot tell a mistake; here it is told, or argued away by "//! ordered: REASON".
// No OpenGL calls.

#include "gpu/shader_source.h"

namespace bounce {

/// One line each, with its place: an image or storage block that is only read or only written and does not say so
/// (readonly, writeonly), or is read and written, without an order. What a function does with it counts, whoever calls
/// that function. Includes are shared by programs that use them differently: they need not say readonly and writeonly.
/// Of text that is no GLSL, what can be followed.
std::vector<std::string> order_problems(const ShaderSource& source);

} // namespace bounce
