#include "gpu/glsl_structure.h"

#include <fmt/format.h>
#include <utility>

namespace bounce {

static bool is_operator(std::string_view t) {
    return !t.empty() && std::string_view("+-*/%<>=!&|^~?.").find(t[0]) != std::string_view::npos;
}

static bool begins_statement(std::string_view t) {
    return t == "if" || t == "else" || t == "for" || t == "while" || t == "do" || t == "switch" || t == "return";
}

void check_nesting(const std::vector<GlslToken>& tokens, const ShaderLimits& limits) {
    std::vector<int64_t> rows = {0};
    int64_t sum = 0;
    auto start_again = [&] { sum -= std::exchange(rows.back(), 0); };
    for (const GlslToken& token : tokens) {
        std::string_view t = token.text;
        if (t == "," || t == ";" || t == "{" || t == "}" || begins_statement(t)) start_again();
        if (bracket_of(t) > 0) {
            if (t == "[" || t == "(") ++rows.back(), ++sum;
            rows.push_back(0);
            if (int64_t(rows.size()) - 1 > limits.nesting)
                throw BeyondLimit(token.line,
                                  fmt::format("'{}' is nested more than {} deep (nesting)", t, limits.nesting));
        } else if (bracket_of(t) < 0) {
            start_again();
            if (rows.size() > 1) rows.pop_back();
            if (t == "}") start_again();
        } else if (is_operator(t)) {
            ++rows.back(), ++sum;
        }
        if (sum > limits.operators)
            throw BeyondLimit(token.line, fmt::format("more than {} operators in a row in one expression (operators)",
                                                      limits.operators));
    }
}

} // namespace bounce
