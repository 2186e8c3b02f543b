#pragma once
// What expanded GLSL asks of a compiler: how much its variables hold, how often its loops run, how large its functions
// are when they are put in the places of their calls, how deep its statements and expressions nest.

#include "gpu/glsl_tokens.h"

#include <map>
#include <string_view>
#include <vector>

namespace bounce {

/// 1 for a bracket that opens, of any kind; −1 for one that closes; 0 for all else.
inline int bracket_of(std::string_view token) {
    if (token == "(" || token == "[" || token == "{") return 1;
    return token == ")" || token == "]" || token == "}" ? -1 : 0;
}

enum class GlslStorage { local, global, shared_memory, uniform, buffer };

struct GlslFunction {
    std::string_view name;
    int line = 0;
    double tokens = 0; ///< of its body
    std::vector<std::string_view> calls;
    size_t begin = 0, end = 0; ///< its body: tokens from the first to before the second
};

/// A variable outside of functions that is no constant, and in no block.
struct GlslVariable {
    std::string_view name, type;
    GlslStorage storage = GlslStorage::global;
    double bytes = 0; ///< of all elements
    double count = 1; ///< elements
    bool is_output = false;
};

struct GlslBlock {
    std::string_view name;
    GlslStorage storage = GlslStorage::global; ///< global: of inputs or outputs
    double bytes = 0;                          ///< of all elements; without what has no size
    std::vector<std::string_view> means;       ///< what code names it by: its instance, or else its members
};

/// What stands outside of functions, and the functions. Names point into the tokens.
struct GlslOutline {
    std::vector<GlslFunction> functions;
    std::vector<GlslVariable> variables;
    std::vector<GlslBlock> blocks;
    std::map<std::string_view, double> constants; ///< global ones whose value is known, and that nothing hides
};

/// Throws BeyondLimit at the first token that goes beyond `limits`. Text that is no GLSL is judged as far as it can be
/// followed: the driver tells what is wrong with it.
GlslOutline check_structure(const std::vector<GlslToken>& tokens, const ShaderLimits& limits);

/// The part of it that is about brackets and rows of operators: an expression's tree is at most as deep as it has
/// operators in a row, on all levels of brackets together.
void check_nesting(const std::vector<GlslToken>& tokens, const ShaderLimits& limits);

/// The part of it that is about calls. Compilers put functions in the places of their calls: what calls two that each
/// call two … doubles. A call means what is defined above it, of its overloads the largest; or else, where it is only
/// named above, what is below.
void check_calls(const std::vector<GlslFunction>& functions, const ShaderLimits& limits);

} // namespace bounce
