#include "gpu/shader_memory.h"

#include "gpu/format.h"
#include "gpu/glsl_tokens.h"

#include <algorithm>
#include <vector>

namespace bounce {

namespace {

using Words = std::vector<std::string_view>;

bool has(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_image_type(std::string_view word) {
    if (word.starts_with("u") || (word.starts_with("i") && !word.starts_with("image"))) word.remove_prefix(1);
    return word.starts_with("image") && word.size() > 5;
}

ShaderMemory memory_of(const Words& words) {
    ShaderMemory memory;
    memory.reads = !has(words, "writeonly");
    memory.writes = !has(words, "readonly");
    memory.coherent = has(words, "coherent") || has(words, "volatile");
    return memory;
}

/// "layout(rgba16f) coherent uniform image2D a_b, a_c[4]", without its semicolon.
void read_images(const Words& words, std::map<std::string, ShaderMemory>& found) {
    auto type = std::find_if(words.begin(), words.end(), is_image_type);
    if (type == words.end() || std::find(words.begin(), type, "uniform") == type) return;
    ShaderMemory memory = memory_of(words);
    memory.is_image = true;
    const std::vector<std::string> formats = format_names();
    for (auto word = words.begin(); word != type; ++word)
        if (std::find(formats.begin(), formats.end(), *word) != formats.end())
            memory.format = format_by_name(std::string(*word)).internal;
    int depth = 0;
    for (auto word = type + 1; word != words.end(); ++word) {
        if (*word == "[") ++depth;
        if (*word == "]") --depth;
        if (depth == 0 && (std::isalpha(static_cast<unsigned char>((*word)[0])) || (*word)[0] == '_'))
            found[std::string(*word)] = memory;
    }
}

} // namespace

std::map<std::string, ShaderMemory> read_shader_memory(const std::string& text) {
    std::map<std::string, ShaderMemory> found;
    GlslTokens tokens;
    try {
        tokens = preprocess(text, ShaderLimits{});
    } catch (const BeyondLimit&) {
        return found; // such text has been refused
    }
    Words words; // of the declaration that is being read
    for (const GlslToken& token : tokens.tokens) {
        if (token == ";" || token == "{" || token == "}") {
            if (token == ";") read_images(words, found);
            auto buffer = std::find(words.begin(), words.end(), "buffer");
            if (token == "{" && buffer != words.end() && buffer + 1 != words.end())
                found[std::string(*(buffer + 1))] = memory_of(words);
            words.clear();
        } else {
            words.push_back(token.text);
        }
    }
    return found;
}

} // namespace bounce
