// What comments, line ends and odd bytes do to shader text: what they hide is not there.
#include "gpu/shader_source.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

class ShaderText : public testing::Test {
  protected:
    ShaderSource expand(const std::string& text) {
        folder.write("main.comp", text);
        return expand_shader("main.comp", folder.path(), {}, {});
    }
    /// The slots, then the parameters, by name.
    static std::vector<std::string> names(const ShaderSource& source) {
        std::vector<std::string> out;
        for (const ShaderSlot& slot : source.slots)
            out.push_back(slot.name);
        for (const ParameterInfo& parameter : source.parameters)
            out.push_back(parameter.name);
        return out;
    }
    TempFolder folder;
};

} // namespace

TEST_F(ShaderText, ACommentThatBeginsBehindCodeHidesParametersAndSlots) {
    ShaderSource source = expand(R"(uniform sampler2D out_radiance;
uniform float strength = 1.0; //! [0, 2] strength
const float k_x = 1.0; /* the old way:
uniform float ghost = 1.0;  //! [0, 2] an old parameter
uniform sampler2D old_missing;
*/
uniform sampler2D out_more;
)");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_THAT(names(source), ElementsAre("out.radiance", "out.more", "strength"));
}

TEST_F(ShaderText, ACommentThatBeginsBehindCodeHidesIncludes) {
    ShaderSource source = expand("int k_y = 1; /*\n#include \"none.glsl\"\n*/\nvoid main() {}\n");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_THAT(source.missing, IsEmpty());
}

TEST_F(ShaderText, EveryWayToCommentOut) {
    ShaderSource source = expand(R"(
//#include "none.glsl"
// #include "none.glsl" \
uniform sampler2D a_continued;
/* #include "none.glsl" */
/* // */ uniform sampler2D a_seen;
// /*
uniform sampler2D a_seen_too;
// */
uniform /* sampler2D a_hidden; */ sampler2D a_seen_three;
uniform sampler2D a_seen_four; // uniform sampler2D a_hidden;
uniform float x = 1.0; // not //! [0, 2] a parameter
uniform float y = 1.0; /* //! [0, 2] neither */
uniform float z = /* 2.0 */ 1.0; /* why */ //! [0, 2] z
#define NOTE /* a directive's comment
#include "none.glsl"
*/ 1
/*
*/ #define HERE
#ifdef HERE
uniform sampler2D a_defined;
#endif
#if 0 // comment
#include "none.glsl"
uniform sampler2D a_off;
#endif /* comment */
)");
    EXPECT_THAT(source.errors, IsEmpty()) << source.errors.front().text();
    EXPECT_THAT(names(source), ElementsAre("a.seen", "a.seen_too", "a.seen_three", "a.seen_four", "a.defined", "z"));
}

TEST_F(ShaderText, WhatIsReplacedStillEndsItsComment) {
    folder.write("lib.glsl", "float lib;\n");
    ShaderSource source =
        expand("/* a\n*/ #include \"lib.glsl\"\n/*\n*/ #version 450\n/*\n*/ uniform int n = 4; //! static n\n"
               "/*\n*/ #extension GL_ARB_shader_ballot : enable\nfloat end;\n");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_EQ(source.text,
              "#version 460 core\n#extension GL_ARB_shader_ballot : enable\n/* a\n*/\nfloat lib;\n/*\n*/\n//\n"
              "/*\n*/\n#define n 4\n/*\n*/\n//\nfloat end;\n");
    EXPECT_EQ(source.lines.size(), 15u);
}

TEST_F(ShaderText, ByteOrderMarksAndLineEnds) {
    folder.write("lib.glsl", "\xEF\xBB\xBF"
                             "float lib;\r\n");
    ShaderSource source =
        expand("\xEF\xBB\xBF#version 460\r\n#include \"lib.glsl\"\r\nuniform float x = 1.0; //! [0, 2] x\r\n"
               "#define TWO \\\r\n  2.0\r\nfloat old;\rfloat mac;\r");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_EQ(source.text,
              "#version 460 core\n//\nfloat lib;\nuniform float x = 1.0; //! [0, 2] x\n#define TWO \\\n  2.0\n"
              "float old;\nfloat mac;\n");
    EXPECT_THAT(names(source), ElementsAre("x"));
    EXPECT_EQ(source.parameters[0].where, "main.comp:3");
}

TEST_F(ShaderText, ABackslashAtTheEndOfAnIncludeTakesNothingIn) {
    folder.write("lib.glsl", "// lib \\");
    EXPECT_THAT(expand("#include \"lib.glsl\"\nfloat a;\n").text, HasSubstr("// lib \nfloat a;\n"));
}

TEST_F(ShaderText, WhatIsNoTextIsOneError) {
    for (const auto& [text, why] :
         {std::pair(std::string("\xFF\xFE") + "v\0o\0", "UTF-16"), std::pair(std::string("float\0 a;", 9), "zero byte"),
          std::pair(std::string("int a; /* never\nends\n"), "does not end")}) {
        ShaderSource source = expand(text);
        ASSERT_EQ(source.errors.size(), 1u) << why;
        EXPECT_THAT(source.errors[0].text(), HasSubstr(why));
    }
    EXPECT_EQ(expand("int a;\nint b; /* never\nends\n").errors[0].line, 2) << "where it begins";
    folder.write("lib.glsl", "float a; /* open");
    ShaderSource source = expand("#include \"lib.glsl\"\nuniform sampler2D a_seen;\n");
    ASSERT_EQ(source.errors.size(), 1u);
    EXPECT_EQ(source.errors[0].file, "lib.glsl");
    EXPECT_THAT(names(source), ElementsAre("a.seen")) << "a comment ends with its file";
}

TEST_F(ShaderText, DeclarationsOverLinesAndSeveralOnOne) {
    ShaderSource source = expand(R"(layout(r32ui)
    readonly
    uniform uimage2D
        a_long;
uniform sampler2D a_b, a_c[2], a_d [N * (2 + 1)]; uniform isampler3D a_e;
layout(std430)
readonly buffer a_f
{
    uint values[];
}; //! optional
layout(std430) writeonly buffer a_g { uint more[]; } names;
uniform sampler2D a_h; //! optional
uniform sampler2D \
    a_i;
float f(sampler2D not_a_slot, in image2D neither) { return 0.0; }
struct Buffer { float buffer_like; };
)");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_THAT(names(source), ElementsAre("a.long", "a.b", "a.c", "a.d", "a.e", "a.f", "a.g", "a.h", "a.i"));
    EXPECT_FALSE(source.slots[0].writes) << "readonly stands on another line";
    EXPECT_EQ(source.slots[0].where, "main.comp:4");
    EXPECT_EQ(source.slots[4].type, "isampler3D");
    EXPECT_FALSE(source.slots[5].writes);
    EXPECT_FALSE(source.slots[6].reads);
    EXPECT_FALSE(source.slots[6].optional);
    EXPECT_TRUE(source.slots[7].optional);
    EXPECT_FALSE(source.slots[8].optional);
}

TEST_F(ShaderText, BranchesBelowOneThatHoldsAreDead) {
    ShaderSource source =
        expand("#if 1\n#elif OTHER\nuniform sampler2D a_dead;\n#else\nuniform sampler2D a_dead_too;\n#endif\n"
               "#if 0\n#elif OTHER\nuniform sampler2D a_open;\n#else\nuniform sampler2D a_open_too;\n#endif\n");
    EXPECT_THAT(names(source), ElementsAre("a.open", "a.open_too"));
    EXPECT_FALSE(source.slots[1].certain);
}

TEST_F(ShaderText, LongLinesOfEveryKind) {
    const std::string filler(40000, 'x');
    for (const std::string& line : {"#define A " + filler,
                                    "#" + filler,
                                    "#include " + filler,
                                    "#include \"" + filler + "\" //",
                                    "#if " + filler,
                                    "#ifdef " + filler,
                                    "uniform float " + filler + ";",
                                    "uniform float x = " + filler + "; //! [0, 1] x",
                                    "uniform float x = 1.0; //! [0, 1] " + filler,
                                    "uniform vec3 x = vec3(" + filler + "); //! x",
                                    "uniform sampler2D a_" + filler + ";",
                                    "uniform " + filler + " sampler2D a_b;",
                                    "layout(std430) buffer " + filler + " {",
                                    "buffer " + std::string(40000, ' ') + "a_b {",
                                    "// " + filler,
                                    "/* " + filler + " */",
                                    std::string(40000, '('),
                                    "float a[" + std::string(40000, '[') + "];",
                                    std::string(40000, '"'),
                                    std::string(40000, '\\')}) {
        ShaderSource source = expand(line + "\nuniform sampler2D a_after;\n");
        for (const ShaderError& error : source.errors)
            EXPECT_LT(error.text().size(), 90000u) << line.substr(0, 20);
    }
    ShaderSource source = expand("#define A " + filler + "\nuniform sampler2D a_after;\n");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_THAT(names(source), ElementsAre("a.after"));
    EXPECT_THAT(source.text, HasSubstr(filler));
}

TEST_F(ShaderText, AnIncludeWithSomethingBehindItIsRefused) {
    folder.write("lib.glsl", "float lib;\n");
    EXPECT_THAT(expand("#include \"lib.glsl\" float lost;\n").errors.at(0).message, HasSubstr("#include \"file\""));
    EXPECT_THAT(expand("#include \"\"\n").errors.at(0).message, HasSubstr("#include \"file\""));
    EXPECT_THAT(expand("#include \"lib.glsl\" // why\n").errors, IsEmpty());
}
