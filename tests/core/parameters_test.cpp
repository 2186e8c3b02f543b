// Values of every kind, as people and files write them; ranges; who set what.
#include "core/parameters.h"
#include "support/errors.h"

#include <cmath>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace bounce;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

ParameterInfo of(ParameterKind kind, double min = -INFINITY, double max = INFINITY) {
    ParameterInfo info;
    info.name = "p";
    info.kind = kind;
    info.min = min;
    info.max = max;
    if (kind == ParameterKind::enumeration) info.choices = {"soft", "hard", "none"};
    return info;
}

ParameterValue text(const ParameterInfo& info, std::string_view value) {
    return parse_value(info, value);
}

std::string refusal(const ParameterInfo& info, std::string_view value) {
    return error_of([&] { parse_value(info, value); });
}

std::string json_refusal(const ParameterInfo& info, const json& value) {
    return error_of([&] { parse_value(info, value); });
}

} // namespace

TEST(Parameters, TextOfEveryKind) {
    using enum ParameterKind;
    EXPECT_EQ(text(of(boolean), "true"), ParameterValue(true));
    EXPECT_EQ(text(of(boolean), " off "), ParameterValue(false));
    EXPECT_EQ(text(of(boolean), "1"), ParameterValue(true));
    EXPECT_EQ(text(of(integer), "-3"), ParameterValue(-3));
    EXPECT_EQ(text(of(integer), "1e3"), ParameterValue(1000));
    EXPECT_EQ(text(of(enumeration), "hard"), ParameterValue(1));
    EXPECT_EQ(text(of(real), "+0.25"), ParameterValue(0.25f));
    EXPECT_EQ(text(of(vec2), "1, 2"), ParameterValue(glm::vec2(1, 2)));
    EXPECT_EQ(text(of(vec3), "1,0,-0.5"), ParameterValue(glm::vec3(1, 0, -0.5f)));
    EXPECT_EQ(text(of(vec4), "1,2,3,4"), ParameterValue(glm::vec4(1, 2, 3, 4)));
    EXPECT_EQ(text(of(colour), "0.5"), ParameterValue(glm::vec3(0.5f))) << "one number is all components";
}

TEST(Parameters, JsonOfEveryKind) {
    using enum ParameterKind;
    auto from = [](ParameterKind kind, const json& value) { return parse_value(of(kind), value); };
    EXPECT_EQ(from(boolean, true), ParameterValue(true));
    EXPECT_EQ(from(integer, 7), ParameterValue(7));
    EXPECT_EQ(from(integer, 7.0), ParameterValue(7));
    EXPECT_EQ(from(enumeration, "none"), ParameterValue(2));
    EXPECT_EQ(from(real, 0.1), ParameterValue(0.1f));
    EXPECT_EQ(from(vec2, json::array({1, 2})), ParameterValue(glm::vec2(1, 2)));
    EXPECT_EQ(from(colour, json::array({1, 0.5, 0})), ParameterValue(glm::vec3(1, 0.5f, 0)));
    EXPECT_EQ(from(vec4, "1,2,3,4"), ParameterValue(glm::vec4(1, 2, 3, 4)));
}

TEST(Parameters, WhatIsNoValueIsToldWithWhatWouldBe) {
    using enum ParameterKind;
    EXPECT_EQ(refusal(of(boolean), "yes"), "'yes' is not a value for parameter 'p': it takes true or false");
    EXPECT_THAT(refusal(of(integer), "1.5"), HasSubstr("a whole number"));
    EXPECT_THAT(refusal(of(integer), "3000000000"), HasSubstr("a whole number"));
    EXPECT_EQ(refusal(of(enumeration), "hrad"), "'hrad' is not a choice of parameter 'p' (did you mean 'hard'?)");
    for (const char* bad : {"", "one", "1 2", "0x10", "1,2", "nan", "inf", "-inf", "1e400", "1f"})
        EXPECT_THAT(refusal(of(real), bad), HasSubstr("'p'")) << bad;
    EXPECT_THAT(refusal(of(vec3), "1,2"), HasSubstr("three numbers (x,y,z)"));
    EXPECT_THAT(refusal(of(vec2), "1,,2"), HasSubstr("two numbers (x,y)"));
    for (const json& bad : {json(1), json(nullptr), json("yes"), json::object()})
        EXPECT_THAT(json_refusal(of(boolean), bad), HasSubstr("true or false")) << bad;
    for (const json& bad : {json(true), json(nullptr), json::array({1}), json::object()})
        EXPECT_THAT(json_refusal(of(real), bad), HasSubstr("a number")) << bad;
    EXPECT_THAT(json_refusal(of(vec3), json::array({1, "2", 3})), HasSubstr("three numbers"));
    EXPECT_THAT(json_refusal(of(vec3), json::array()), HasSubstr("three numbers"));
}

TEST(Parameters, RangesAreInclusiveAndOfEachComponent) {
    ParameterInfo real = of(ParameterKind::real, 0.1, 2);
    EXPECT_THAT(refusal(real, "0.1"), IsEmpty()) << "the bound itself, as a float";
    EXPECT_THAT(refusal(real, "2"), IsEmpty());
    EXPECT_EQ(refusal(real, "2.5"), "'2.5' is out of range for parameter 'p': it takes a number [0.1, 2]");
    EXPECT_THAT(refusal(real, "0.0999"), HasSubstr("out of range"));
    EXPECT_THAT(refusal(of(ParameterKind::vec3, 0, 1), "0,1,1.01"), HasSubstr("out of range"));
    EXPECT_THAT(json_refusal(of(ParameterKind::integer, 1, 8), json(9)), HasSubstr("[1, 8]"));
}

TEST(Parameters, JsonAndTextReadBackAsTheSameValue) {
    using enum ParameterKind;
    std::pair<ParameterInfo, ParameterValue> values[] = {
        {of(boolean), true},
        {of(integer), -2147483647},
        {of(integer), 16777217}, // not a float
        {of(enumeration), 2},
        {of(real), 0.1f},
        {of(real), 1.17549435e-38f},
        {of(real), 3.4e38f},
        {of(vec2), glm::vec2(1.0f / 3, -2.0f / 3)},
        {of(colour), glm::vec3(0.1f, 0.2f, 0.3f)},
        {of(vec4), glm::vec4(1e-7f, 1e7f, 0, 1)},
    };
    for (auto& [info, value] : values) {
        EXPECT_EQ(parse_value(info, std::string_view(to_text(info, value))), value) << to_text(info, value);
        EXPECT_EQ(parse_value(info, json::parse(to_json(info, value).dump())), value) << to_json(info, value);
    }
    EXPECT_EQ(to_json(of(real), 0.1f).dump(), "0.1");
    EXPECT_EQ(to_text(of(enumeration), 1), "hard");
}

TEST(Parameters, MembersFollowAndKnowWhoSetThem) {
    int steps = 4;
    float scale = 0.5f;
    bool on = true;
    enum class Mode { a, b } mode = Mode::a;
    ParameterSet set;
    set.add("steps", steps, {1, 8}, "voxels", "how many");
    set.add("scale", scale, {0, 1}, "", "how long");
    set.add("on", on, "whether");
    set.add_choice("mode", mode, {"a", "b"}, "which");
    EXPECT_THAT(set.names(), ElementsAre("steps", "scale", "on", "mode"));
    set.set_text("steps", "6", ParameterOrigin::command_line);
    set.set_json("mode", "b", ParameterOrigin::graph);
    set.set_text("on", "false", ParameterOrigin::panel);
    EXPECT_EQ(steps, 6);
    EXPECT_EQ(mode, Mode::b);
    EXPECT_FALSE(on);
    EXPECT_EQ(set.find("steps")->origin, ParameterOrigin::command_line);
    EXPECT_EQ(set.find("scale")->origin, ParameterOrigin::default_value);
    EXPECT_THAT(error_of([&] { set.set_text("steps", "9", ParameterOrigin::panel); }), HasSubstr("[1, 8]"));
    EXPECT_EQ(steps, 6) << "a refused value changes nothing";
    EXPECT_EQ(error_of([&] { set.set_text("stpes", "1", ParameterOrigin::panel); }),
              "there is no parameter 'stpes' (did you mean 'steps'?)");
    EXPECT_THAT(error_of([&] { set.set("scale", 1, ParameterOrigin::panel); }), HasSubstr("a number"))
        << "an int is no float";
    set.reset("steps");
    EXPECT_EQ(steps, 4);
    EXPECT_EQ(set.find("steps")->origin, ParameterOrigin::default_value);
    EXPECT_THAT(error_of([&] { set.add("on", on, "again"); }), HasSubstr("declared twice"));
}

TEST(Parameters, ShaderParametersKeepValuesByNameAndKind) {
    auto declare = [](ParameterSet& set, const std::string& line) {
        ParameterInfo info;
        ASSERT_TRUE(parse_parameter_line(line, info));
        set.declare_shader_parameter(info);
    };
    ParameterSet set;
    declare(set, "uniform float gain = 1.0; //! [0, 9] gain");
    set.set_text("gain", "5", ParameterOrigin::panel);
    declare(set, "uniform float gain = 2.0; //! [0, 6] gain, with another default and range");
    EXPECT_EQ(set.find("gain")->value, ParameterValue(5.0f));
    EXPECT_EQ(set.find("gain")->origin, ParameterOrigin::panel);
    declare(set, "uniform float gain = 2.0; //! [0, 4] too narrow now");
    EXPECT_EQ(set.find("gain")->value, ParameterValue(2.0f));
    EXPECT_EQ(set.find("gain")->origin, ParameterOrigin::default_value);
    declare(set, "uniform float gain = 3.0; //! [0, 4] nobody had set it");
    EXPECT_EQ(set.find("gain")->value, ParameterValue(3.0f));
    set.set_text("gain", "1", ParameterOrigin::panel);
    declare(set, "uniform int gain = 2; //! [0, 4] of another kind");
    EXPECT_EQ(set.find("gain")->value, ParameterValue(2));

    float own = 1;
    set.add("own", own, {0, 1}, "", "of the pass");
    declare(set, "uniform float own = 0.5; //! [0, 100] fed by the pass's");
    EXPECT_EQ(set.find("own")->info.max, 1);
    set.keep_shader_parameters({});
    EXPECT_EQ(set.find("gain"), nullptr);
    EXPECT_NE(set.find("own"), nullptr);
}
