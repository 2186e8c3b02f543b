// Macros and conditions, as a preprocessor follows them. Each token carries the macros that it came out of, which are
// not expanded in it again (Prosser's algorithm); all work is counted.
#include "core/source_lines.h"
#include "gpu/glsl_constants.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <utility>

namespace bounce {

namespace {

/// A list of macros, shared by all tokens that came out of them.
struct Hidden {
    std::string_view macro;
    std::shared_ptr<const Hidden> above;
    int depth = 1;
};
using HiddenList = std::shared_ptr<const Hidden>;

bool contains(const Hidden* hidden, std::string_view macro) {
    while (hidden && hidden->macro.data() != macro.data())
        hidden = hidden->above.get();
    return hidden;
}

struct Token {
    GlslToken token;
    HiddenList hidden;
};

struct Macro {
    std::string_view name; ///< in the store: the same for all lists
    bool takes_arguments = false;
    std::vector<std::string_view> parameters;
    std::vector<GlslToken> body;
};

class Preprocessor {
  public:
    explicit Preprocessor(const ShaderLimits& limits) : limits_(limits) {
        for (const char* line :
             {"define __VERSION__ 460", "define GL_core_profile 1", "define __LINE__ 1", "define __FILE__ 0"})
            define(tokens_of(line, 0));
    }

    GlslTokens run(const std::string& text) {
        std::optional<std::string> why_not;
        CodeLines lines(split_lines(text, why_not));
        std::vector<Token> code; // since the last directive
        while (std::optional<CodeLine> line = lines.next()) {
            result_.store.push_back(std::move(line->code));
            std::vector<GlslToken> tokens = tokens_of(result_.store.back(), line->number);
            if (line->directive) {
                expand_code(code);
                directive(tokens, line->number);
            } else if (active()) {
                check_nesting(tokens);
                for (const GlslToken& token : tokens)
                    code.push_back({token, nullptr});
            }
        }
        expand_code(code);
        return std::move(result_);
    }

  private:
    /// Before anything recursive sees it: parentheses in the text as it is written.
    void check_nesting(const std::vector<GlslToken>& tokens) {
        for (const GlslToken& token : tokens) {
            if (token == "(" || token == "[" || token == "{") ++open_;
            if (token == ")" || token == "]" || token == "}") open_ = std::max<int64_t>(0, open_ - 1);
            if (open_ > limits_.nesting)
                throw BeyondLimit(
                    token.line, fmt::format("'{}' is nested more than {} deep (nesting)", token.text, limits_.nesting));
        }
    }

    bool active() const { return dead_ == 0; }

    // --- directives ---

    struct If {
        bool holds, any_held;
    };

    void push_condition(bool holds, int line) {
        conditions_.push_back({holds, holds});
        dead_ += !holds;
        if (int64_t(conditions_.size()) > limits_.nesting)
            throw BeyondLimit(line, fmt::format("#if is nested more than {} deep (nesting)", limits_.nesting));
    }

    void directive(const std::vector<GlslToken>& tokens, int line) {
        if (tokens.size() < 2) return;
        std::string_view kind = tokens[1].text;
        std::string_view name = tokens.size() > 2 ? tokens[2].text : std::string_view();
        std::vector<GlslToken> rest(tokens.begin() + 2, tokens.end());
        if (kind == "ifdef" || kind == "ifndef") {
            push_condition(active() && macros_.contains(name) == (kind == "ifdef"), line);
        } else if (kind == "if") {
            push_condition(active() && condition(rest), line);
        } else if (kind == "elif" || kind == "else") {
            if (conditions_.empty()) return;
            If& top = conditions_.back();
            dead_ -= !top.holds;
            top.holds = !top.any_held && active() && (kind == "else" || condition(rest));
            top.any_held = top.any_held || top.holds;
            dead_ += !top.holds;
        } else if (kind == "endif") {
            if (conditions_.empty()) return;
            dead_ -= !conditions_.back().holds;
            conditions_.pop_back();
        } else if (!active()) {
            return;
        } else if (kind == "define") {
            define({tokens.begin() + 1, tokens.end()});
        } else if (kind == "undef") {
            macros_.erase(name);
        } else if (kind == "extension" && tokens.size() > 4 && tokens[4].text != "disable") {
            define(tokens_of(result_.store.emplace_back(fmt::format("define {} 1", name)), line));
        }
    }

    /// `tokens`: from "define" on.
    void define(const std::vector<GlslToken>& tokens) {
        if (tokens.size() < 2 || !tokens[1].is_word()) return;
        Macro macro;
        macro.name = tokens[1].text;
        size_t at = 2;
        // A list of parameters touches the name: else the parenthesis is part of the body.
        if (tokens.size() > 2 && tokens[2] == "(" && tokens[2].text.data() == macro.name.data() + macro.name.size()) {
            macro.takes_arguments = true;
            for (at = 3; at < tokens.size() && tokens[at].text != ")"; ++at)
                if (tokens[at].is_word()) macro.parameters.push_back(tokens[at].text);
            ++at;
        }
        if (at <= tokens.size()) macro.body.assign(tokens.begin() + long(at), tokens.end());
        macros_[macro.name] = std::move(macro);
    }

    bool condition(const std::vector<GlslToken>& tokens) {
        std::vector<Token> line;
        for (size_t i = 0; i < tokens.size(); ++i) {
            if (tokens[i] != "defined") {
                line.push_back({tokens[i], nullptr});
                continue;
            }
            size_t name = i + 1 < tokens.size() && tokens[i + 1] == "(" ? i + 2 : i + 1;
            bool known = name < tokens.size() && macros_.contains(tokens[name].text);
            line.push_back({{known ? "1" : "0", tokens[i].line}, nullptr});
            i = name == i + 2 ? name + 1 : name;
        }
        std::vector<GlslToken> expanded;
        for (const Token& token : expand(std::move(line), 0))
            expanded.push_back(token.token);
        return constant_value(expanded, [](std::string_view) { return 0.0; }).value_or(0) != 0;
    }

    // --- macros ---

    void expand_code(std::vector<Token>& code) {
        if (code.empty()) return;
        for (const Token& token : expand(std::exchange(code, {}), 0))
            result_.tokens.push_back(token.token);
        if (int64_t(result_.tokens.size()) > limits_.tokens)
            throw BeyondLimit(result_.tokens[size_t(limits_.tokens)].line,
                              fmt::format("more than {} tokens, all macros expanded (tokens)", limits_.tokens));
    }

    void count_work(size_t tokens, int line) {
        work_ += int64_t(tokens);
        if (work_ > 4 * limits_.tokens)
            throw BeyondLimit(line, fmt::format("macros expand to more than {} tokens (tokens)", limits_.tokens));
    }

    std::vector<Token> expand(std::vector<Token> input, int depth) {
        if (depth > limits_.nesting)
            throw BeyondLimit(
                input.front().token.line,
                fmt::format("macros in the arguments of macros, more than {} deep (nesting)", limits_.nesting));
        std::reverse(input.begin(), input.end());
        std::vector<Token>& rest = input; // from its end on
        std::vector<Token> out;
        while (!rest.empty()) {
            Token next = std::move(rest.back());
            rest.pop_back();
            auto found = next.token.is_word() ? macros_.find(next.token.text) : macros_.end();
            bool calls = !rest.empty() && rest.back().token == "(";
            if (found == macros_.end() || contains(next.hidden.get(), found->second.name) ||
                (found->second.takes_arguments && !calls)) {
                out.push_back(std::move(next));
                count_work(1, out.back().token.line);
                continue;
            }
            const Macro& macro = found->second;
            HiddenList hidden = std::make_shared<const Hidden>(
                Hidden{macro.name, next.hidden, next.hidden ? next.hidden->depth + 1 : 1});
            if (hidden->depth > limits_.macro_depth)
                throw BeyondLimit(next.token.line,
                                  fmt::format("the macro '{}' comes out of more than {} others (macro_depth)",
                                              macro.name, limits_.macro_depth));
            std::vector<std::vector<Token>> arguments;
            if (macro.takes_arguments && !read_arguments(rest, arguments)) {
                out.push_back(std::move(next)); // not closed: for the driver to tell
                continue;
            }
            replace(macro, arguments, hidden, next.token.line, depth, rest);
        }
        return out;
    }

    /// Takes "( … )" off the end of `rest`, split at its own commas.
    bool read_arguments(std::vector<Token>& rest, std::vector<std::vector<Token>>& arguments) {
        int open = 0;
        size_t at = rest.size();
        arguments.emplace_back();
        while (at > 0) {
            const Token& token = rest[--at];
            bool opens = token.token == "(", closes = token.token == ")";
            open += opens - closes;
            if (closes && open == 0) {
                count_work(rest.size() - at, token.token.line);
                rest.resize(at);
                return true;
            }
            if (opens && open == 1) continue;
            if (open == 1 && token.token == ",")
                arguments.emplace_back();
            else
                arguments.back().push_back(token);
        }
        if (!rest.empty()) count_work(rest.size(), rest.front().token.line);
        return false;
    }

    /// Puts the macro's body, with its arguments in their places, at the end of `rest`.
    void replace(const Macro& macro, const std::vector<std::vector<Token>>& arguments, const HiddenList& hidden,
                 int line, int depth, std::vector<Token>& rest) {
        std::vector<Token> out;
        std::map<size_t, std::vector<Token>> expanded; // of each parameter, once
        auto add = [&](const Token& token) {
            count_work(1, line);
            out.push_back(token);
        };
        for (size_t i = 0; i < macro.body.size(); ++i) {
            const GlslToken& part = macro.body[i];
            bool pasted =
                (i > 0 && macro.body[i - 1] == "##") || (i + 1 < macro.body.size() && macro.body[i + 1] == "##");
            auto parameter = std::find(macro.parameters.begin(), macro.parameters.end(), part.text);
            size_t index = size_t(parameter - macro.parameters.begin());
            size_t before = out.size();
            if (part == "##" && i > 0) continue;
            if (parameter == macro.parameters.end() || !macro.takes_arguments) {
                add({{part.text, line}, hidden});
            } else if (index < arguments.size()) {
                if (!pasted && !expanded.contains(index) && !arguments[index].empty())
                    expanded[index] = expand(arguments[index], depth + 1);
                for (const Token& token : pasted ? arguments[index] : expanded[index])
                    add(token);
            }
            if (i > 0 && macro.body[i - 1] == "##" && before > 0 && before < out.size()) paste(out, before);
        }
        for (Token& token : out)
            token.token.line = line;
        rest.insert(rest.end(), std::make_move_iterator(out.rbegin()), std::make_move_iterator(out.rend()));
    }

    void paste(std::vector<Token>& out, size_t at) {
        std::string both = std::string(out[at - 1].token.text) + std::string(out[at].token.text);
        count_work(both.size(), out[at].token.line);
        out[at - 1].token.text = result_.store.emplace_back(std::move(both));
        out.erase(out.begin() + long(at));
    }

    const ShaderLimits& limits_;
    GlslTokens result_;
    std::map<std::string_view, Macro> macros_;
    std::vector<If> conditions_;
    int64_t dead_ = 0; ///< how many of them do not hold
    int64_t open_ = 0;
    int64_t work_ = 0;
};

} // namespace

GlslTokens preprocess(const std::string& text, const ShaderLimits& limits) {
    return Preprocessor(limits).run(text);
}

} // namespace bounce
