// The `uniform … //! …` lines of shaders.
#include "core/parameters.h"
#include "support/errors.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

ParameterInfo line(const std::string& text) {
    ParameterInfo info;
    EXPECT_TRUE(parse_parameter_line(text, info)) << text;
    return info;
}

bool is_none(const std::string& text) {
    ParameterInfo info;
    return !parse_parameter_line(text, info);
}

std::string refusal(const std::string& text) {
    ParameterInfo info;
    return error_of([&] { parse_parameter_line(text, info); });
}

} // namespace

TEST(ParameterLine, RangeUnitAndHelp) {
    ParameterInfo info =
        line("  uniform float step_scale = 0.5f;  //! [0.1, 2] (voxels) step length as a share of the cone's diameter");
    EXPECT_EQ(info.name, "step_scale");
    EXPECT_EQ(info.kind, ParameterKind::real);
    EXPECT_EQ(info.default_value, ParameterValue(0.5f));
    EXPECT_EQ(float(info.min), 0.1f);
    EXPECT_EQ(info.max, 2);
    EXPECT_EQ(info.unit, "voxels");
    EXPECT_EQ(info.help, "step length as a share of the cone's diameter");
    EXPECT_TRUE(info.in_shader);
    EXPECT_FALSE(info.is_static);
}

TEST(ParameterLine, EveryKind) {
    EXPECT_EQ(line("uniform bool on = true; //! whether").default_value, ParameterValue(true));
    EXPECT_EQ(line("uniform bool on; //!").default_value, ParameterValue(false));
    EXPECT_EQ(line("uniform int n = -3; //! [-4, 4] n").default_value, ParameterValue(-3));
    EXPECT_EQ(line("uniform vec2 v = vec2(1, .5); //! [0, 1] v").default_value, ParameterValue(glm::vec2(1, 0.5f)));
    EXPECT_EQ(line("uniform vec4 v = vec4(2.); //! v").default_value, ParameterValue(glm::vec4(2)));
    ParameterInfo colour = line("uniform vec3 tint = vec3(1.0, 0.8f, 0); //! what the light is multiplied by");
    EXPECT_EQ(colour.kind, ParameterKind::colour);
    EXPECT_EQ(colour.default_value, ParameterValue(glm::vec3(1, 0.8f, 0)));
    EXPECT_EQ(line("uniform vec3 offset = vec3(0); //! [-1, 1] a vector: it has a range").kind, ParameterKind::vec3);
    EXPECT_EQ(line("uniform float f = 1e-3; //! f").default_value, ParameterValue(1e-3f));
}

TEST(ParameterLine, ChoicesNameTheValuesOfAnInt) {
    ParameterInfo info =
        line("uniform int occlusion = 1; //! {shadow_map, ray_hard, ray_soft} how the light is blocked");
    EXPECT_EQ(info.kind, ParameterKind::enumeration);
    EXPECT_THAT(info.choices, ElementsAre("shadow_map", "ray_hard", "ray_soft"));
    EXPECT_EQ(info.default_value, ParameterValue(1));
    EXPECT_EQ(info.help, "how the light is blocked");
}

TEST(ParameterLine, StaticOnes) {
    ParameterInfo info = line("uniform int cones = 6; //! static [1, 32] diffuse cones");
    EXPECT_TRUE(info.is_static);
    EXPECT_EQ(info.max, 32);
    EXPECT_EQ(info.help, "diffuse cones");
    EXPECT_TRUE(line("uniform bool on = true; //! static").is_static);
    EXPECT_FALSE(line("uniform bool on = true; //! statically speaking").is_static);
}

TEST(ParameterLine, OtherLinesAreNone) {
    for (const char* other :
         {"uniform float x = 1.0;", "uniform float x = 1.0; // plain", "uniform sampler2D a_b; //! optional",
          "layout(rgba16f) uniform image2D a_b; //! optional", "float x = 1.0; //! [0, 1] no uniform", "//! a remark",
          "uniform usampler3D a_b; //! optional", ""})
        EXPECT_TRUE(is_none(other)) << other;
}

TEST(ParameterLine, MalformedOnesAreToldByName) {
    EXPECT_THAT(refusal("uniform float x = 1.0; //! [0.1 2] no comma"),
                HasSubstr("the range of 'x' is written [least, greatest]"));
    EXPECT_THAT(refusal("uniform float x = 1.0; //! [0, 2 no end"), HasSubstr("the range of 'x'"));
    EXPECT_THAT(refusal("uniform float x = 1.0; //! [2, 0] turned round"), HasSubstr("empty"));
    EXPECT_THAT(refusal("uniform float x = 1.0; //! [a, b] letters"), HasSubstr("'a'"));
    EXPECT_THAT(refusal("uniform float x = 3.0; //! [0, 2] default outside"), HasSubstr("the default of 'x'"));
    EXPECT_THAT(refusal("uniform int x; //! [1, 2] no default, and 0 is outside"), HasSubstr("the default of 'x'"));
    EXPECT_THAT(refusal("uniform float x = other; //! [0, 2] not a number"), HasSubstr("the default of 'x'"));
    EXPECT_THAT(refusal("uniform float x = 1.0; //! {a, b} choices of a float"), HasSubstr("on a uniform int"));
    EXPECT_THAT(refusal("uniform int x = 0; //! {a, b no end"), HasSubstr("{a, b, c}"));
    EXPECT_THAT(refusal("uniform int x = 2; //! {a, b} no third"), HasSubstr("the default of 'x'"));
    EXPECT_THAT(refusal("uniform mat4 x; //! [0, 1] a matrix"), HasSubstr("cannot be of type 'mat4'"));
    EXPECT_THAT(refusal("uniform float x = 1.0, y = 2.0; //! [0, 9] two at once"), HasSubstr("the default of 'x'"));
    EXPECT_THAT(refusal("uniform vec3 x = vec3(1, 2); //! two of three"), HasSubstr("the default of 'x'"));
    EXPECT_THAT(refusal("uniform int x = 0; //! {} no choices"), HasSubstr("'x'"));
}
