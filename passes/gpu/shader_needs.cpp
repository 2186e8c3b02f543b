#include "gpu/shader_needs.h"

#include "core/digest.h"
#include "gpu/glsl_constants.h"
#include "gpu/glsl_structure.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace bounce {

namespace {

/// The words of all that main reaches.
class Reached {
  public:
    Reached(const std::vector<GlslToken>& tokens, const GlslOutline& outline) : tokens_(tokens), outline_(outline) {
        open_.emplace_back("main");
        std::set<std::string_view> seen = {"main"};
        while (!open_.empty()) {
            const std::string_view name = open_.back();
            open_.pop_back();
            for (const GlslFunction& function : outline.functions)
                if (function.name == name) walk(function.begin, function.end);
            for (const GlslFunction& function : outline.functions)
                if (words_.contains(function.name) && seen.insert(function.name).second) open_.push_back(function.name);
        }
    }
    bool has(std::string_view word) const { return words_.contains(word); }

  private:
    std::string_view text(size_t at) const { return at < tokens_.size() ? tokens_[at].text : std::string_view(); }

    size_t closed(size_t at) const {
        for (int depth = 0; at < tokens_.size(); ++at)
            if ((depth += bracket_of(text(at))) <= 0) return at + 1;
        return at;
    }

    /// Behind the statement that begins at `at`.
    size_t statement_end(size_t at) const {
        while (text(at) == "if" || text(at) == "for" || text(at) == "while" || text(at) == "switch") {
            const bool is_if = text(at) == "if";
            at = closed(at + 1);
            if (!is_if) continue;
            at = statement_end(at);
            if (text(at) != "else") return at;
            ++at;
        }
        if (text(at) == "{") return closed(at);
        if (text(at) == "do") at = statement_end(at + 1);
        for (int depth = 0; at < tokens_.size(); ++at) {
            depth += bracket_of(text(at));
            if (depth < 0) return at;
            if (depth == 0 && text(at) == ";") return at + 1;
        }
        return at;
    }

    std::optional<double> constant(size_t begin, size_t end) const {
        return constant_value(std::span(tokens_).subspan(begin, end - begin), [&](std::string_view name) {
            auto known = outline_.constants.find(name);
            return known == outline_.constants.end() ? std::nullopt : std::optional(known->second);
        });
    }

    void walk(size_t at, size_t end) {
        while (at < end) {
            if (text(at) != "if" || text(at + 1) != "(") {
                if (tokens_[at].is_word() && text(at - 1) != ".") words_.insert(text(at));
                ++at;
                continue;
            }
            const size_t then = closed(at + 1);
            const std::optional<double> holds = then > at + 3 ? constant(at + 2, then - 1) : std::nullopt;
            if (!holds) {
                ++at;
                continue;
            }
            const size_t otherwise = statement_end(then);
            const size_t last = text(otherwise) == "else" ? statement_end(otherwise + 1) : otherwise;
            if (*holds != 0)
                walk(then, std::min(otherwise, end));
            else if (last > otherwise)
                walk(otherwise + 1, std::min(last, end));
            at = std::max(last, at + 1);
        }
    }

    const std::vector<GlslToken>& tokens_;
    const GlslOutline& outline_;
    std::vector<std::string_view> open_; ///< functions to be walked
    std::set<std::string_view> words_;
};

std::string_view without_sign(std::string_view type) {
    if (type.starts_with("u") || (type.starts_with("i") && !type.starts_with("image"))) type.remove_prefix(1);
    return type;
}

/// "local_size_x = 8": the constant behind a layout's qualifier.
double layout_value(const std::vector<GlslToken>& tokens, const GlslOutline& outline, std::string_view qualifier,
                    double otherwise) {
    for (size_t at = 0; at + 2 < tokens.size(); ++at) {
        if (!(tokens[at] == qualifier) || !(tokens[at + 1] == "=")) continue;
        size_t end = at + 2;
        for (int depth = 0; end < tokens.size(); ++end) {
            if (depth == 0 && (tokens[end] == "," || tokens[end] == ")")) break;
            depth += bracket_of(tokens[end].text);
        }
        const auto value = constant_value(std::span(tokens).subspan(at + 2, end - at - 2), [&](std::string_view name) {
            auto known = outline.constants.find(name);
            return known == outline.constants.end() ? std::nullopt : std::optional(known->second);
        });
        return value.value_or(otherwise);
    }
    return otherwise;
}

void add_variable(const GlslVariable& variable, ShaderNeeds& needs) {
    const std::string_view kind = without_sign(variable.type);
    const bool sampler = kind.starts_with("sampler"), image = kind.starts_with("image");
    if (variable.storage == GlslStorage::uniform && (sampler || image)) {
        auto& names = sampler ? needs.samplers : needs.images;
        const bool is_array = variable.count > 1;
        for (int i = 0; i < int(variable.count); ++i)
            names.push_back(is_array ? fmt::format("{}[{}]", variable.name, i) : std::string(variable.name));
    } else if (variable.storage == GlslStorage::uniform) {
        needs.uniform_components += int64_t(std::ceil(variable.bytes / 4));
    } else if (variable.storage == GlslStorage::shared_memory) {
        const bool three = variable.type.ends_with("vec3");
        needs.shared_bytes += int64_t(std::ceil(variable.bytes * (three ? 4.0 / 3.0 : 1.0)));
    } else if (variable.is_output && needs.stage == ShaderStage::fragment) {
        needs.outputs += int64_t(variable.count);
    }
}

ShaderNeeds read_needs(const std::string& text, ShaderStage stage) {
    ShaderNeeds needs;
    needs.stage = stage;
    try {
        const GlslTokens tokens = preprocess(text, shader_limits());
        const GlslOutline outline = check_structure(tokens.tokens, shader_limits());
        const Reached reached(tokens.tokens, outline);
        for (const GlslVariable& variable : outline.variables)
            if (reached.has(variable.name)) add_variable(variable, needs);
        for (const GlslBlock& block : outline.blocks) {
            // All blocks but packed ones are active, used or not (OpenGL 4.6, §7.6).
            if (block.storage == GlslStorage::buffer) needs.storage_blocks.emplace_back(block.name);
            if (block.storage != GlslStorage::uniform) continue;
            needs.uniform_blocks.emplace_back(block.name);
            needs.uniform_block_bytes = std::max(needs.uniform_block_bytes, int64_t(block.bytes));
        }
        const auto value = [&](const char* name, double otherwise) {
            return layout_value(tokens.tokens, outline, name, otherwise);
        };
        if (stage == ShaderStage::compute)
            needs.local_size = {int(value("local_size_x", 1)), int(value("local_size_y", 1)),
                                int(value("local_size_z", 1))};
        if (stage == ShaderStage::geometry) needs.output_vertices = int64_t(value("max_vertices", 0));
        needs.layer_from_vertex =
            stage == ShaderStage::vertex && (reached.has("gl_Layer") || reached.has("gl_ViewportIndex"));
    } catch (const BeyondLimit&) {
        // Such text is refused for that.
    }
    return needs;
}

} // namespace

ShaderNeeds shader_needs(const std::string& text, ShaderStage stage) {
    // A plan asks for all of its programs again, of which few have changed.
    constexpr size_t k_kept = 128; // stages; a graph has some sixty
    static std::map<uint64_t, ShaderNeeds> known;
    const uint64_t key = Digest().add(text).add(int(stage)).value();
    auto found = known.find(key);
    if (found != known.end()) return found->second;
    if (known.size() >= k_kept) known.clear();
    return known[key] = read_needs(text, stage);
}

} // namespace bounce
