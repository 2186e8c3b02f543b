#pragma once
// GLSL text as tokens, its macros expanded and its conditions followed, as a compiler's preprocessor does, within
// limits. For judging a text before a driver sees it: what is wrong in it is left for the driver to tell.

#include "gpu/shader_limits.h"

#include <deque>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bounce {

/// The text goes beyond a limit at a line of the flat text (1-based).
struct BeyondLimit : std::runtime_error {
    BeyondLimit(int at, const std::string& what) : std::runtime_error(what), line(at) {}
    int line;
};

struct GlslToken {
    std::string_view text;
    int line = 0; ///< of the flat text, 1-based: where it is written, or where the macro is used that it comes from
    bool is_word() const;
    bool is_number() const;
    bool operator==(std::string_view other) const { return text == other; }
};

struct GlslTokens {
    std::deque<std::string> store; ///< what the tokens' texts point into
    std::vector<GlslToken> tokens;
};

/// Splits one line of code (without comments). The tokens point into `code`.
std::vector<GlslToken> tokens_of(std::string_view code, int line);

/// All of a stage. Throws BeyondLimit.
GlslTokens preprocess(const std::string& text, const ShaderLimits& limits);

} // namespace bounce
