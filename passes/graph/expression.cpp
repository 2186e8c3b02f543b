#include "graph/expression.h"

#include "core/error.h"

#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <muParser.h>

namespace bounce {

namespace {
/// muParser asks for the address of each unknown variable; the values live as long as the evaluation.
struct Variables {
    const NameLookup* lookup;
    std::deque<double> values;
    std::string unknown;
};

double* make_variable(const mu::char_type* name, void* data) {
    auto* variables = static_cast<Variables*>(data);
    std::optional<double> value = (*variables->lookup)(name);
    if (!value) {
        if (variables->unknown.empty()) variables->unknown = name;
        value = 1;
    }
    variables->values.push_back(*value);
    return &variables->values.back();
}
} // namespace

double evaluate(const std::string& expression, const NameLookup& lookup) {
    Variables variables{&lookup, {}, {}};
    double result = 0;
    try {
        mu::Parser parser;
        parser.DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
        parser.DefineFun("ceil", [](double v) { return std::ceil(v); });
        parser.DefineFun("floor", [](double v) { return std::floor(v); });
        parser.SetVarFactory(make_variable, &variables);
        parser.SetExpr(expression);
        result = parser.Eval();
    } catch (const mu::Parser::exception_type& error) {
        throw Error(fmt::format("'{}' is no expression: {}", expression, error.GetMsg()));
    }
    if (!variables.unknown.empty()) {
        throw Error(fmt::format("'{}' in '{}' is no name that is known here", variables.unknown, expression));
    }
    if (!std::isfinite(result)) throw Error(fmt::format("'{}' gives no finite number", expression));
    return result;
}

int evaluate_integer(const std::string& expression, const NameLookup& lookup, int least) {
    double value = std::floor(evaluate(expression, lookup) + 1e-9);
    if (value < least || value > 1 << 30) {
        throw Error(value < least ? fmt::format("'{}' gives {}; it must be at least {}", expression, value, least)
                                  : fmt::format("'{}' gives {}; it must be at most {}", expression, value, 1 << 30));
    }
    return int(value);
}

} // namespace bounce
