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
    if (name == "direct.visibility") return 1;
    if (name == "other.visibility") return 0;
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

TEST(Expression, Logic) {
    EXPECT_EQ(evaluate("width && graph.scale", names), 1);
    EXPECT_EQ(evaluate("width && 0 || 0", names), 0);
    EXPECT_EQ(evaluate("!(width > 600) || !0", names), 1);
    EXPECT_EQ(evaluate("!width != 1", names), 1);
    EXPECT_EQ(evaluate("true && !false", names), 1);
}

TEST(Expression, EnumerationsAreComparedByName) {
    static const std::vector<std::string> choices = {"shadow_map", "cones", "width"};
    Names with(names);
    with.choices = [](const std::string& name) { return name.ends_with(".visibility") ? &choices : nullptr; };
    with.known = [] { return std::vector<std::string>{"width", "graph.scale"}; };
    EXPECT_EQ(evaluate("direct.visibility == cones", with), 1);
    EXPECT_EQ(evaluate("shadow_map != direct.visibility && width", with), 1);
    EXPECT_EQ(evaluate("direct.visibility==shadow_map||other.visibility==shadow_map", with), 1);
    EXPECT_EQ(evaluate("direct.visibility == width", with), 0) << "a choice goes before a name";
    EXPECT_EQ(evaluate("direct.visibility == other.visibility", with), 0);
    EXPECT_EQ(evaluate("direct.visibility == 1", with), 1);
    EXPECT_THAT(
        error_of([&] { evaluate("direct.visibility == cone", with); }),
        HasSubstr(
            "invalid choice 'cone' of 'direct.visibility' in 'direct.visibility == cone' (did you mean 'cones'?)"));
    EXPECT_THAT(error_of([&] { evaluate("widht * 2", with); }), HasSubstr("(did you mean 'width'?)"));
    EXPECT_THAT(error_of([&] { evaluate("width == cones", with); }),
                HasSubstr("'cones' in 'width == cones' is no name"));
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
