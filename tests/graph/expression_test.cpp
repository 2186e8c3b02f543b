// Arithmetic in graph files.
#include "graph/expression.h"
#include "support/errors.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::HasSubstr;

namespace {
std::optional<double> names(const std::string& name) {
    if (name == "width") return 641;
    if (name == "graph.scale") return 0.5;
    if (name == "gbuffer.normal.width") return 320;
    return std::nullopt;
}
} // namespace

TEST(Expression, NumbersNamesAndFunctions) {
    EXPECT_DOUBLE_EQ(evaluate("2 + 3 * 4", names), 14);
    EXPECT_DOUBLE_EQ(evaluate("width * graph.scale", names), 320.5);
    EXPECT_DOUBLE_EQ(evaluate("gbuffer.normal.width / 2", names), 160);
    EXPECT_DOUBLE_EQ(evaluate("max(1, ceil(width / 16))", names), 41);
    EXPECT_DOUBLE_EQ(evaluate("floor(log2(width)) + 1", names), 10);
    EXPECT_DOUBLE_EQ(evaluate("width > 600 ? 2 : 1", names), 2);
    EXPECT_DOUBLE_EQ(evaluate("2 ^ 3", names), 8);
}

TEST(Expression, WholeNumbersAreRoundedDown) {
    EXPECT_EQ(evaluate_integer("width / 2", names, 1), 320);
    EXPECT_EQ(evaluate_integer("0.1 * 30", names, 1), 3) << "2.9999999999999996 is 3";
    EXPECT_THAT(error_of([] { evaluate_integer("width - 641", names, 1); }), HasSubstr("must be at least 1"));
    EXPECT_THAT(error_of([] { evaluate_integer("width ^ 8", names, 1); }), HasSubstr("must be at most"));
}

TEST(Expression, WhatIsWrongIsTold) {
    EXPECT_THAT(error_of([] { evaluate("widht / 2", names); }),
                HasSubstr("'widht' in 'widht / 2' is no name that is known here"));
    EXPECT_THAT(error_of([] { evaluate("width /", names); }), HasSubstr("'width /' is no expression"));
    EXPECT_THAT(error_of([] { evaluate("", names); }), HasSubstr("is no expression"));
    EXPECT_THAT(error_of([] { evaluate("1 / 0", names); }), HasSubstr("no finite number"));
    EXPECT_THAT(error_of([] { evaluate("sqrt(0 - 1)", names); }), HasSubstr("no finite number"));
}
