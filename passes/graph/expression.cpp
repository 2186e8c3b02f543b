#include "graph/expression.h"

#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <muParser.h>
#include <string_view>

namespace bounce {

namespace {
/// muParser asks for the address of each unknown variable; the values live as long as the evaluation.
struct Variables {
    const Names* names;
    std::deque<double> values;
    std::string unknown;
};

double* make_variable(const mu::char_type* name, void* data) {
    auto* variables = static_cast<Variables*>(data);
    std::optional<double> value = variables->names->value(name);
    if (!value) {
        if (variables->unknown.empty()) variables->unknown = name;
        value = 1;
    }
    variables->values.push_back(*value);
    return &variables->values.back();
}

bool is_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

struct Token {
    size_t begin = 0, end = 0;
    std::string text;
};

/// Names and numbers whole, "==" and "!=" whole, everything else one character each.
std::vector<Token> tokens_of(const std::string& expression) {
    std::vector<Token> tokens;
    for (size_t at = 0; at < expression.size();) {
        size_t end = at + 1;
        if (is_name(expression[at])) {
            while (end < expression.size() && is_name(expression[end]))
                ++end;
        } else if ((expression[at] == '=' || expression[at] == '!') && end < expression.size() &&
                   expression[end] == '=') {
            ++end;
        }
        if (!std::isspace(static_cast<unsigned char>(expression[at])))
            tokens.push_back({at, end, expression.substr(at, end - at)});
        at = end;
    }
    return tokens;
}

/// "direct.visibility == cones" → "direct.visibility == 1".
std::string with_numbers_for_choices(const std::string& expression, const Names& names) {
    if (!names.choices) return expression;
    std::vector<Token> tokens = tokens_of(expression);
    std::vector<std::pair<const Token*, size_t>> replaced;
    for (size_t i = 1; i + 1 < tokens.size(); ++i) {
        if (tokens[i].text != "==" && tokens[i].text != "!=") continue;
        for (auto [of, with] : {std::pair(&tokens[i - 1], &tokens[i + 1]), std::pair(&tokens[i + 1], &tokens[i - 1])}) {
            const std::vector<std::string>* choices = names.choices(of->text);
            if (!choices || !std::isalpha(static_cast<unsigned char>(with->text.front()))) continue;
            auto found = std::find(choices->begin(), choices->end(), with->text);
            if (found != choices->end())
                replaced.emplace_back(with, size_t(found - choices->begin()));
            else if (!names.value(with->text))
                throw Error(fmt::format("invalid choice '{}' of '{}' in '{}'{}", with->text, of->text, expression,
                                        did_you_mean(with->text, *choices)));
        }
    }
    std::sort(replaced.begin(), replaced.end(), [](auto& a, auto& b) { return a.first->begin > b.first->begin; });
    std::string out = expression;
    for (const auto& [token, number] : replaced)
        out.replace(token->begin, token->end - token->begin, std::to_string(number));
    return out;
}
} // namespace

double evaluate(const std::string& expression, const Names& names) {
    Variables variables{&names, {}, {}};
    double result = 0;
    try {
        mu::Parser parser;
        parser.DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
        parser.DefineFun("ceil", [](double v) { return std::ceil(v); });
        parser.DefineFun("floor", [](double v) { return std::floor(v); });
        parser.DefineInfixOprt("!", [](double v) { return v == 0 ? 1.0 : 0.0; });
        parser.DefineConst("true", 1);
        parser.DefineConst("false", 0);
        parser.SetVarFactory(make_variable, &variables);
        parser.SetExpr(with_numbers_for_choices(expression, names));
        result = parser.Eval();
    } catch (const mu::Parser::exception_type& error) {
        throw Error(fmt::format("'{}' is no expression: {}", expression, error.GetMsg()));
    }
    if (!variables.unknown.empty()) {
        auto nearest = names.known ? nearest_name(variables.unknown, names.known()) : std::nullopt;
        throw Error(fmt::format("'{}' in '{}' is no name that is known here{}", variables.unknown, expression,
                                nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""));
    }
    if (!std::isfinite(result)) throw Error(fmt::format("'{}' gives no finite number", expression));
    return result;
}

int evaluate_integer(const std::string& expression, const Names& names, int least) {
    double value = std::floor(evaluate(expression, names) + 1e-9);
    if (value < least || value > 1 << 30) {
        throw Error(value < least ? fmt::format("'{}' gives {}; it must be at least {}", expression, value, least)
                                  : fmt::format("'{}' gives {}; it must be at most {}", expression, value, 1 << 30));
    }
    return int(value);
}

} // namespace bounce
