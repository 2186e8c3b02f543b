#include "gpu/shader_limits.h"

#include "core/error.h"
#include "core/scanner.h"
#include "core/text.h"
#include "gpu/glsl_structure.h"
#include "gpu/glsl_tokens.h"
#include "gpu/shader_location.h"

#include <charconv>
#include <fmt/format.h>

namespace bounce {

static ShaderLimits& limits_in_force() {
    static ShaderLimits limits;
    return limits;
}

const ShaderLimits& shader_limits() {
    return limits_in_force();
}

void set_shader_limits(const ShaderLimits& limits) {
    limits_in_force() = limits;
}

const std::vector<ShaderLimitEntry>& shader_limit_entries() {
    static const std::vector<ShaderLimitEntry> entries = {
        {"text_bytes", &ShaderLimits::text_bytes, "bytes of a stage with its includes"},
        {"files", &ShaderLimits::files, "files of a stage"},
        {"include_depth", &ShaderLimits::include_depth, "includes in includes"},
        {"parameters", &ShaderLimits::parameters, "//! parameters of a stage"},
        {"slots", &ShaderLimits::slots, "samplers, images and storage blocks of a stage"},
        {"tokens", &ShaderLimits::tokens, "tokens of a stage, macros expanded"},
        {"macro_depth", &ShaderLimits::macro_depth, "macros that expand to macros"},
        {"nesting", &ShaderLimits::nesting, "nested brackets, statements and #if"},
        {"operators", &ShaderLimits::operators, "operators in a row in one expression"},
        {"inlined_tokens", &ShaderLimits::inlined_tokens, "tokens of a function with all that it calls"},
        {"loop_iterations", &ShaderLimits::loop_iterations, "rounds of nested loops with constant bounds"},
        {"private_bytes", &ShaderLimits::private_bytes, "bytes of a function's variables, or of the global ones"},
        {"shared_bytes", &ShaderLimits::shared_bytes, "bytes of the shared variables"},
        {"uniform_bytes", &ShaderLimits::uniform_bytes, "bytes of the uniforms, or of a uniform block"},
        {"buffer_bytes", &ShaderLimits::buffer_bytes, "bytes of a storage block of fixed size"},
        {"interface_names", &ShaderLimits::interface_names, "names of uniforms and blocks"},
    };
    return entries;
}

void set_shader_limit(const std::string& text) {
    size_t equals = text.find('=');
    std::string name = text.substr(0, equals);
    std::vector<std::string> names;
    for (const ShaderLimitEntry& entry : shader_limit_entries()) {
        names.push_back(entry.name);
        if (name != entry.name) continue;
        int64_t value = 0;
        const char* end = text.data() + text.size();
        const char* begin = equals == std::string::npos ? end : text.data() + equals + 1;
        auto [stop, problem] = std::from_chars(begin, end, value);
        if (problem != std::errc() || stop != end || value < 1)
            throw Error(
                fmt::format("invalid shader limit '{}': expected {}=N, a whole number above 0", shortened(text), name));
        limits_in_force().*entry.value = value;
        return;
    }
    throw Error(fmt::format("invalid shader limit '{}'{}", shortened(name), did_you_mean(name, names)));
}

std::vector<ShaderError> check_shader_limits(const ShaderSource& source, const std::filesystem::path& folder) {
    try {
        GlslTokens tokens = preprocess(source.text, shader_limits());
        check_structure(tokens.tokens, shader_limits());
        return {};
    } catch (const BeyondLimit& problem) {
        return {
            located_error(source, folder, problem.line,
                          std::string("beyond a limit: ") + problem.what() + "; --shader-limit NAME=N sets another")};
    }
}

} // namespace bounce
