// The value "auto": which parameters take it, what it becomes, and what is told of it.
#include "core/error.h"
#include "core/parameter_steps.h"
#include "support/errors.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace bounce;
using testing::HasSubstr;

namespace {

struct AutoParameters : testing::Test {
    AutoParameters() {
        set.add("resolution", resolution, {8, 512}, "voxels", "along each side");
        choose_powers_of_two(set, "resolution");
        set.follow_need("resolution", "voxels");
        set.add("scale", scale, {0.125, 1}, "", "a share");
    }
    const Parameter& parameter() { return *set.find("resolution"); }

    int resolution = 64;
    float scale = 0.5f;
    ParameterSet set;
};

} // namespace

TEST_F(AutoParameters, TheValueStandsUntilTheSceneIsThere) {
    set.set_text("resolution", "auto", ParameterOrigin::graph);
    EXPECT_TRUE(parameter().is_auto);
    EXPECT_EQ(parameter().text(), "auto");
    EXPECT_EQ(parameter().reason, "");
    EXPECT_EQ(resolution, 64);
    set.resolve("resolution", 100, "arches of 0.9 m");
    EXPECT_EQ(resolution, 128) << "the step that is not below the need";
    EXPECT_EQ(parameter().text(), "auto");
    EXPECT_EQ(parameter().reason, "arches of 0.9 m");
    EXPECT_EQ(parameter().origin, ParameterOrigin::graph);
}

TEST_F(AutoParameters, AValueTakesItsPlace) {
    set.set_json("resolution", nlohmann::json("auto"), ParameterOrigin::command_line);
    set.resolve("resolution", 256, "why");
    set.set_text("resolution", "32", ParameterOrigin::panel);
    EXPECT_FALSE(parameter().is_auto);
    EXPECT_EQ(parameter().reason, "");
    EXPECT_EQ(parameter().text(), "32");
    set.set_text("resolution", "auto", ParameterOrigin::panel);
    set.reset("resolution");
    EXPECT_FALSE(parameter().is_auto);
    EXPECT_EQ(resolution, 64);
}

TEST_F(AutoParameters, OthersRefuseIt) {
    const std::string message = error_of([&] { set.set_text("scale", "auto", ParameterOrigin::graph); });
    EXPECT_THAT(message, HasSubstr("'auto' is not a value for parameter 'scale'"));
    EXPECT_THAT(error_of([&] { set.set_text("resolution", "much", ParameterOrigin::graph); }), HasSubstr("or auto"));
}

TEST_F(AutoParameters, NeedsBeyondTheRangeTakeItsEnds) {
    const ParameterInfo& info = parameter().info;
    EXPECT_EQ(value_for(info, 5000), ParameterValue(512));
    EXPECT_EQ(value_for(info, 0), ParameterValue(8));
    EXPECT_EQ(value_for(info, 128), ParameterValue(128));
    EXPECT_EQ(value_for(set.find("scale")->info, 0.3), ParameterValue(0.3f));
    ParameterInfo whole;
    whole.kind = ParameterKind::integer;
    EXPECT_EQ(value_for(whole, 12.6), ParameterValue(13));
}

TEST(AutoLines, AShaderSaysWhatItFollows) {
    ParameterInfo info;
    ASSERT_TRUE(parse_parameter_line("uniform int rays = 16;  //! [1, 64] auto(cones) (rays) of a texel", info));
    EXPECT_EQ(info.automatic, "cones");
    EXPECT_EQ(info.unit, "rays");
    EXPECT_EQ(info.help, "of a texel");
    ASSERT_TRUE(parse_parameter_line("uniform int rays = 16;  //! [1, 64] automatic is a word of the help", info));
    EXPECT_EQ(info.automatic, "");
    EXPECT_THROW(parse_parameter_line("uniform int rays = 16;  //! [1, 64] auto(", info), Error);
    EXPECT_THROW(parse_parameter_line("uniform int rays = 16;  //! [1, 64] auto() rays", info), Error);
}

TEST(AutoLines, AReloadKeepsIt) {
    ParameterSet set;
    ParameterInfo info;
    ASSERT_TRUE(parse_parameter_line("uniform int rays = 16;  //! [1, 64] auto(cones) rays", info));
    set.declare_shader_parameter(info);
    set.set_text("rays", "auto", ParameterOrigin::graph);
    set.resolve("rays", 40, "why");
    info.default_value = 8;
    set.declare_shader_parameter(info);
    EXPECT_TRUE(set.find("rays")->is_auto);
    EXPECT_EQ(set.find("rays")->value, ParameterValue(40));
    info.automatic = "";
    set.declare_shader_parameter(info);
    EXPECT_FALSE(set.find("rays")->is_auto);
}
