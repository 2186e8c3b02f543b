// Numbers that take some values alone.
#include "core/error.h"
#include "core/parameter_steps.h"
#include "support/errors.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

ParameterValue value(const ParameterInfo& info, std::string_view text) {
    return parse_value(info, text);
}

ParameterInfo line(const std::string& text) {
    ParameterInfo info;
    EXPECT_TRUE(parse_parameter_line(text, info)) << text;
    return info;
}

} // namespace

TEST(ParameterSteps, NumbersInBracesAreTheValuesOfANumber) {
    const ParameterInfo info = line("uniform int cells = 64;  //! {32, 64, 128} (voxels) along a side");
    EXPECT_EQ(info.kind, ParameterKind::integer);
    EXPECT_THAT(info.choices, ElementsAre("32", "64", "128"));
    EXPECT_EQ(info.default_value, ParameterValue(64));
    EXPECT_EQ(info.unit, "voxels");
    EXPECT_EQ(range_text(info), "{32, 64, 128}");
    EXPECT_EQ(value(info, "128"), ParameterValue(128));
    EXPECT_EQ(to_text(info, ParameterValue(128)), "128");
    EXPECT_EQ(to_json(info, ParameterValue(32)), nlohmann::json(32));
    for (const char* other : {"100", "0", "256", "64.5"})
        EXPECT_THAT(error_of([&] { value(info, other); }), HasSubstr("one of {32, 64, 128}")) << other;
    EXPECT_THAT(error_of([&] { parse_value(info, nlohmann::json(33)); }), HasSubstr("one of {32, 64, 128}"));
}

TEST(ParameterSteps, RealsHaveThemToo) {
    const ParameterInfo info = line("uniform float scale = 0.5;  //! static {1, 0.25, 0.5, 0.1} share");
    EXPECT_EQ(info.kind, ParameterKind::real);
    EXPECT_TRUE(info.is_static);
    EXPECT_THAT(info.choices, ElementsAre("0.1", "0.25", "0.5", "1")) << "rising";
    EXPECT_EQ(value(info, "0.1"), ParameterValue(0.1f));
    EXPECT_NE(error_of([&] { value(info, "0.2"); }), "");
}

TEST(ParameterSteps, NamesStayNames) {
    EXPECT_EQ(line("uniform int hit = 0;  //! {voxel, 2d} what is hit").kind, ParameterKind::enumeration);
    for (const char* wrong : {"uniform int n = 1;  //! {0.5, 1} halves of a whole number",
                              "uniform int n = 5;  //! {32, 64} its default is none of them",
                              "uniform float x = 1.0;  //! {a, b} a number with names",
                              "uniform vec2 x = vec2(1.0);  //! {1, 2} two numbers"}) {
        ParameterInfo info;
        EXPECT_THROW(parse_parameter_line(wrong, info), Error) << wrong;
    }
}

TEST(ParameterSteps, PowersOfTwoOfAPass) {
    int side = 64;
    ParameterSet set;
    set.add("side", side, {8, 300}, "voxels", "a side");
    choose_powers_of_two(set, "side");
    EXPECT_THAT(set.find("side")->info.choices, ElementsAre("8", "16", "32", "64", "128", "256"));
    set.set_text("side", "128", ParameterOrigin::panel);
    EXPECT_EQ(side, 128);
    EXPECT_THROW(set.set_text("side", "100", ParameterOrigin::panel), Error);
    EXPECT_EQ(side, 128);
}

TEST(ParameterSteps, Neighbours) {
    const ParameterInfo info = line("uniform int n = 64;  //! {24, 64, 100} n");
    EXPECT_THAT(steps_beside(info, 64), ElementsAre(ParameterValue(24), ParameterValue(100)));
    EXPECT_THAT(steps_beside(info, 24), ElementsAre(ParameterValue(64)));
    EXPECT_THAT(steps_beside(info, 100), ElementsAre(ParameterValue(64)));
    EXPECT_THAT(steps_beside(line("uniform int n = 3; //! [0, 8] n"), 3), IsEmpty());
    EXPECT_THAT(steps_beside(line("uniform int n = 1; //! {a, b} n"), 1), IsEmpty());
}
