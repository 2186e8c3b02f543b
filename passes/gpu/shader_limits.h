#pragma once
// What a shader's text may ask for. Drivers take minutes and gigabytes for some short texts (arrays of a million
// elements, macros that double, functions that call the one before twice), and end the program for others (thousands of
// nested parentheses). Such text is an error row, which the driver never sees.

#include "gpu/shader_source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bounce {

/// The defaults are several times what the shaders of the program need, and far below what hurt a driver.
struct ShaderLimits {
    int64_t text_bytes = 4 << 20;      ///< of a stage with its includes
    int64_t files = 1000;              ///< of a stage
    int64_t include_depth = 64;        ///< includes in includes
    int64_t parameters = 500;          ///< //! lines of a stage
    int64_t slots = 500;               ///< opaque uniforms and storage blocks of a stage
    int64_t tokens = 200000;           ///< of a stage, when its macros are expanded
    int64_t macro_depth = 500;         ///< macros that expand to macros
    int64_t nesting = 200;             ///< parentheses, brackets, braces, statements, #if
    int64_t operators = 1000;          ///< in a row, in one expression
    int64_t inlined_tokens = 150000;   ///< of main, with the functions that it calls put in their places
    int64_t loop_iterations = 1 << 20; ///< of loops with constant bounds, nested ones multiplied
    int64_t private_bytes = 1 << 14;   ///< of the variables of one function, or of all global ones
    int64_t shared_bytes = 1 << 16;    ///< of the shared variables together
    int64_t uniform_bytes = 1 << 16;   ///< of all uniforms, and of each uniform block
    int64_t buffer_bytes = 1 << 30;    ///< of a storage block
    int64_t interface_names = 16384;   ///< of uniforms and blocks: one each element of an array of structures
};

struct ShaderLimitEntry {
    const char* name;
    int64_t ShaderLimits::*value;
    const char* help;
};
/// Every limit by name, for --shader-limit and the table of limits.
const std::vector<ShaderLimitEntry>& shader_limit_entries();

/// Those in force.
const ShaderLimits& shader_limits();
/// "private_bytes=262144". Throws Error for an unknown name or a value below 1.
void set_shader_limit(const std::string& text);
void set_shader_limits(const ShaderLimits& limits);

/// What in an expanded stage goes beyond the limits in force: at most one row, at the line that does.
std::vector<ShaderError> check_shader_limits(const ShaderSource& source, const std::filesystem::path& folder);

} // namespace bounce
