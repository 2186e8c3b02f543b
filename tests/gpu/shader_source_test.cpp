// Expansion of shader text: includes, the line table, slots and parameters. No OpenGL.
#include "gpu/shader_source.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

class Source : public testing::Test {
  protected:
    ShaderSource expand(const std::string& file, const Defines& defines = {}, const Defines& statics = {}) {
        return expand_shader(file, folder.path(), defines, statics);
    }
    /// Every line of the text that is ours is the line that the table says it is.
    void expect_table_holds(const ShaderSource& source) {
        std::vector<std::string> flat = lines_of(source.text);
        ASSERT_EQ(flat.size(), source.lines.size());
        for (size_t i = 0; i < flat.size(); ++i) {
            SourceLocation at = source.lines[i];
            if (!at.line || flat[i].starts_with("//") || flat[i].starts_with("#define")) continue;
            std::vector<std::string> original =
                lines_of(folder.read(source.files[size_t(at.file)].lexically_relative(folder.path())));
            ASSERT_LE(size_t(at.line), original.size());
            // A static enumeration is a constant.
            if (flat[i].starts_with("const int ") &&
                original[size_t(at.line) - 1].find("//! static") != std::string::npos)
                continue;
            EXPECT_EQ(flat[i], original[size_t(at.line) - 1]) << "flat line " << i + 1;
        }
    }
    static std::vector<std::string> names(const ShaderSource& source) {
        std::vector<std::string> out;
        for (const ShaderSlot& slot : source.slots)
            out.push_back(slot.name);
        return out;
    }
    TempFolder folder;
};

} // namespace

/// Once a name, above all code, so that functions that stand before the uniform know them.
TEST_F(Source, ValuesOfEnumerationsHaveNames) {
    folder.write("a.comp", "#include \"used.glsl\"\n"
                           "uniform int way = 1; //! {hard, soft} how\n"
                           "uniform int set = 0; //! static {one, two} which\n"
                           "void main() {}\n");
    folder.write("used.glsl", "uniform int way = 1; //! {hard, soft} how\n");
    ShaderSource source = expand("a.comp");
    EXPECT_THAT(source.errors, IsEmpty());
    std::vector<std::string> flat = lines_of(source.text);
    flat.resize(5);
    EXPECT_THAT(flat, ElementsAre("#version 460 core", "const int way_hard = 0;", "const int way_soft = 1;",
                                  "const int set_one = 0;", "const int set_two = 1;"));
    expect_table_holds(source);
}

TEST_F(Source, IncludesBesideTheFileThenInTheFolderOnceAStage) {
    folder.write("a/main.comp", "// top\n#include \"near.glsl\"\n#include \"lib/far.glsl\"\nvoid main() {}\n");
    folder.write("a/near.glsl", "float near_one;\n#include \"lib/far.glsl\"\nfloat near_two;\n");
    folder.write("near.glsl", "float wrong;\n");
    folder.write("lib/far.glsl", "#include <near.glsl>\nfloat far_one;\n");
    ShaderSource source = expand("a/main.comp");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_EQ(source.files.size(), 4u) << "the file, near beside it, far, and the near of the folder (from far)";
    EXPECT_EQ(source.files[0], folder / "a/main.comp");
    EXPECT_THAT(source.text, HasSubstr("#version 460 core\n// top\nfloat near_one;\nfloat wrong;\nfloat "
                                       "far_one;\nfloat near_two;\nvoid main() {}\n"));
    expect_table_holds(source);
}

TEST_F(Source, VersionAndLineAreIgnoredAndExtensionsHoisted) {
    folder.write("main.comp", "#version 450\nfloat a;\n#include \"lib.glsl\"\n#line 100\nfloat b;\n");
    folder.write("lib.glsl", "\n#extension GL_ARB_shader_ballot : enable\nfloat c;\n");
    ShaderSource source = expand("main.comp", {{"SIZE", "8"}});
    std::vector<std::string> flat = lines_of(source.text);
    EXPECT_THAT(std::vector<std::string>(flat.begin(), flat.begin() + 3),
                ElementsAre("#version 460 core", "#extension GL_ARB_shader_ballot : enable", "#define SIZE 8"));
    EXPECT_THAT(source.text, Not(HasSubstr("#line")));
    EXPECT_EQ(source.text.find("#version"), source.text.rfind("#version 460"));
    expect_table_holds(source);
}

TEST_F(Source, AMissingIncludeIsToldAndWatched) {
    folder.write("main.comp", "float a;\n  #include \"lib/none.glsl\"\n#include none\n");
    ShaderSource source = expand("main.comp");
    ASSERT_EQ(source.errors.size(), 2u);
    EXPECT_EQ(source.errors[0].file, "main.comp");
    EXPECT_EQ(source.errors[0].line, 2);
    EXPECT_EQ(source.errors[0].source_line, "#include \"lib/none.glsl\"");
    EXPECT_THAT(source.errors[0].message, HasSubstr("none.glsl"));
    EXPECT_EQ(source.errors[1].line, 3);
    EXPECT_THAT(source.missing, ElementsAre(folder / "lib/none.glsl"));
    EXPECT_THAT(source.errors[0].text(), HasSubstr("main.comp:2: "));
}

TEST_F(Source, CirclesOfIncludesEnd) {
    folder.write("main.comp", "#include \"a.glsl\"\n");
    folder.write("a.glsl", "#include \"b.glsl\"\nfloat a;\n");
    folder.write("b.glsl", "#include \"a.glsl\"\nfloat b;\n");
    EXPECT_THAT(expand("main.comp").text, HasSubstr("float b;\nfloat a;\n"));
}

TEST_F(Source, AnIncludeThatIsSwitchedOffDoesNotUseUpItsTurn) {
    folder.write("main.comp",
                 "#ifdef NEVER\n#include \"lib.glsl\"\n#include \"gone.glsl\"\n#endif\n#include \"lib.glsl\"\n");
    folder.write("lib.glsl", "float lib;\n");
    ShaderSource source = expand("main.comp");
    EXPECT_THAT(source.errors, IsEmpty());
    std::string text = source.text;
    EXPECT_GT(text.find("float lib;"), text.find("#endif"));
    expect_table_holds(source);
}

TEST_F(Source, WindowsLineEndsAndNoNewlineAtTheEnd) {
    folder.write("main.comp",
                 "float a;\r\n#include \"lib.glsl\"\r\nuniform float x = 1.0; //! [0, 2] x\r\nvoid main() {}");
    folder.write("lib.glsl", "float b;");
    ShaderSource source = expand("main.comp");
    EXPECT_THAT(source.text, HasSubstr("float a;\nfloat b;\nuniform float x"));
    ASSERT_EQ(source.parameters.size(), 1u);
    EXPECT_EQ(source.parameters[0].help, "x");
    EXPECT_EQ(source.parameters[0].where, "main.comp:3");
}

TEST_F(Source, SlotsAndHowTheyAreUsed) {
    folder.write("main.comp", R"(uniform sampler2D gbuffer_normal;
layout(binding = 3) uniform usampler3D voxels_albedo_mips;
layout(FORMAT_out_direct) writeonly uniform image2D out_direct;
layout(r32ui) readonly uniform uimage3D voxels_counts;
layout(r32ui) coherent restrict uniform uimage3D voxels_flags;
layout(std430) readonly buffer scene_lights { int lights[]; };
layout(std430) buffer list_nodes {
layout(std430) writeonly buffer list_heads
{
uniform sampler2D shadow_depth;  //! optional
// uniform sampler2D commented_out;
/* and
uniform sampler2D commented_too;
*/
uniform sampler2D cone_maps[4];
)");
    ShaderSource source = expand("main.comp");
    EXPECT_THAT(source.errors, IsEmpty());
    EXPECT_THAT(names(source),
                ElementsAre("gbuffer.normal", "voxels.albedo_mips", "out.direct", "voxels.counts", "voxels.flags",
                            "scene.lights", "list.nodes", "list.heads", "shadow.depth", "cone.maps"));
    auto access = [&](size_t i) {
        return std::string(source.slots[i].reads ? "r" : "") + (source.slots[i].writes ? "w" : "");
    };
    std::vector<std::string> accesses;
    for (size_t i = 0; i < source.slots.size(); ++i)
        accesses.push_back(access(i));
    EXPECT_THAT(accesses, ElementsAre("r", "r", "w", "r", "rw", "r", "rw", "w", "r", "r"));
    EXPECT_EQ(source.slots[1].type, "usampler3D");
    EXPECT_EQ(source.slots[1].kind, SlotKind::sampled);
    EXPECT_EQ(source.slots[2].kind, SlotKind::image);
    EXPECT_EQ(source.slots[6].kind, SlotKind::storage);
    EXPECT_TRUE(source.slots[8].optional);
    EXPECT_FALSE(source.slots[0].optional);
    EXPECT_EQ(source.slots[2].where, "main.comp:3");
    EXPECT_EQ(slot_identifier("voxels.albedo_mips"), "voxels_albedo_mips");
}

TEST_F(Source, ANameWithoutAGroupIsRefused) {
    folder.write("main.comp", "uniform sampler2D noise;\n");
    ShaderSource source = expand("main.comp");
    ASSERT_EQ(source.errors.size(), 1u);
    EXPECT_THAT(source.errors[0].message, HasSubstr("group_noise"));
}

TEST_F(Source, SlotsBehindConditions) {
    folder.write("main.comp", R"(#define HERE
#ifdef HERE
uniform sampler2D a_here;
#ifndef HERE
uniform sampler2D a_not;
#endif
#else
uniform sampler2D a_otherwise;
#endif
#undef HERE
#ifdef HERE
uniform sampler2D a_undefined;
#else
uniform sampler2D a_after;
#endif
#ifdef GIVEN
uniform sampler2D a_given;
#endif
#if 0
uniform sampler2D a_zero;
#else
uniform sampler2D a_else_of_zero;
#endif
#if SIZE > 4
uniform sampler2D a_unknown;
#endif
)");
    ShaderSource source = expand("main.comp", {{"GIVEN", "1"}});
    EXPECT_THAT(names(source), ElementsAre("a.here", "a.after", "a.given", "a.else_of_zero", "a.unknown"));
    EXPECT_TRUE(source.slots[0].certain);
    EXPECT_FALSE(source.slots[4].certain);
}

TEST_F(Source, StaticParametersBecomeDefines) {
    folder.write("main.comp", R"(uniform int cones = 6; //! static [1, 32] cones
uniform float reach = 2.0; //! static [0, 9] reach
uniform vec3 tint = vec3(1, 0.5, 0); //! static tint
uniform bool on = true; //! static on
uniform int mode = 1; //! static {soft, hard} mode
uniform float plain = 1.0; //! [0, 1] plain
)");
    ShaderSource source = expand("main.comp");
    EXPECT_THAT(source.text, HasSubstr("#define cones 6\n#define reach (2.0)\n#define tint vec3(1,0.5,0)\n#define on "
                                       "true\nconst int mode = 1;\nuniform float plain"));
    EXPECT_EQ(source.parameters.size(), 6u);
    EXPECT_TRUE(source.parameters[0].is_static);
    EXPECT_THAT(expand("main.comp", {}, {{"cones", "9"}}).text, HasSubstr("#define cones 9\n"));
    expect_table_holds(source);
}

/// What only one of its values needs is a slot for that value alone.
TEST_F(Source, StaticBoolsSteerWhichSlotsThereAre) {
    folder.write("main.comp", R"(uniform bool exact = false; //! static exact
#if exact // a comment
uniform sampler2D a_exact;
#else
uniform sampler2D a_rough;
#endif
#if !exact
uniform sampler2D a_mean;
#endif
#if unknown
uniform sampler2D a_unknown;
#endif
)");
    ShaderSource off = expand("main.comp"), on = expand("main.comp", {}, {{"exact", "true"}});
    EXPECT_THAT(names(off), ElementsAre("a.rough", "a.mean", "a.unknown"));
    EXPECT_THAT(names(on), ElementsAre("a.exact", "a.unknown"));
    EXPECT_TRUE(off.slots[0].certain);
    EXPECT_FALSE(off.slots[2].certain);
    EXPECT_THAT(on.text, HasSubstr("#if 1\nuniform sampler2D a_exact;"));
    EXPECT_THAT(off.text, HasSubstr("#if unknown\n")); // the compiler's own business
}

TEST_F(Source, StaticEnumerationsSteerWhichSlotsThereAre) {
    folder.write("main.comp", R"(uniform int kind = 0; //! static {box, plane, triangle} kind
uniform int other = 0; //! {one, two} other
#if kind >= kind_plane
uniform sampler2D a_planes;
#endif
#if kind == kind_triangle
uniform sampler2D a_triangles;
#endif
#if kind != kind_box // a comment
uniform sampler2D a_no_box;
#endif
#if other == other_two
uniform sampler2D a_unknown;
#endif
)");
    EXPECT_THAT(names(expand("main.comp")), ElementsAre("a.unknown"));
    EXPECT_THAT(names(expand("main.comp", {}, {{"kind", "1"}})), ElementsAre("a.planes", "a.no_box", "a.unknown"));
    const ShaderSource triangles = expand("main.comp", {}, {{"kind", "2"}});
    EXPECT_THAT(names(triangles), ElementsAre("a.planes", "a.triangles", "a.no_box", "a.unknown"));
    EXPECT_TRUE(triangles.slots[1].certain);
    EXPECT_FALSE(triangles.slots[3].certain);
}

TEST_F(Source, ParametersOfIncludesBelongToTheStageAndMalformedOnesAreErrors) {
    folder.write("main.comp", "#include \"lib.glsl\"\nuniform float bad = 1.0; //! [1 2] bad\n");
    folder.write("lib.glsl", "\nuniform float good = 1.0; //! [0, 2] good\n");
    ShaderSource source = expand("main.comp");
    ASSERT_EQ(source.parameters.size(), 1u);
    EXPECT_EQ(source.parameters[0].where, "lib.glsl:2");
    ASSERT_EQ(source.errors.size(), 1u);
    EXPECT_EQ(source.errors[0].line, 2);
    EXPECT_EQ(source.errors[0].file, "main.comp");
}

TEST_F(Source, LogsOfAllDriversAreTranslated) {
    folder.write("main.comp", "float a;\n#include \"lib.glsl\"\nfloat b = oops;\n");
    folder.write("lib.glsl", "#extension GL_ARB_shader_ballot : enable\nfloat c = oops;\n");
    ShaderSource source = expand("main.comp");
    // Flat: #version, #extension, a, (the extension's own place), c, b.
    auto translate = [&](const std::string& log) { return translate_log(log, source, folder.path()); };
    for (const char* log : {"0:5(11): error: `oops' undeclared", "0(5) : error C1503: undefined variable \"oops\"",
                            "ERROR: 0:5: 'oops' : undeclared identifier"}) {
        std::vector<ShaderError> errors = translate(log);
        ASSERT_EQ(errors.size(), 1u) << log;
        EXPECT_EQ(errors[0].file, "lib.glsl") << log;
        EXPECT_EQ(errors[0].line, 2) << log;
        EXPECT_EQ(errors[0].source_line, "float c = oops;") << log;
        EXPECT_THAT(errors[0].message, HasSubstr("oops")) << log;
    }
    std::vector<ShaderError> two = translate("0:5(11): error: one\n0:6(11): error: two\n\n");
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[1].file, "main.comp");
    EXPECT_EQ(two[1].line, 3);
    EXPECT_THAT(translate("0:5(11): warning: one\n0(5) : warning C7050: two\nWARNING: 0:5: three\n"), IsEmpty())
        << "warnings are no errors";
    std::vector<ShaderError> odd = translate("Internal error: out of registers");
    ASSERT_EQ(odd.size(), 1u);
    EXPECT_EQ(odd[0].file, "main.comp");
    EXPECT_EQ(odd[0].line, 0);
    EXPECT_EQ(translate("0:999(1): error: beyond the end")[0].line, 0);
}

TEST_F(Source, LinkLogsAreTranslatedToTheStageThatTheyMean) {
    folder.write("main.vert", "out vec3 tint;\nvoid main() { tint = shade(); }\n");
    folder.write("main.frag", "#include \"lib.glsl\"\nin vec4 tint;\n");
    folder.write("lib.glsl", "vec3 shade();\n");
    std::vector<ShaderSource> stages = {expand("main.vert"), expand("main.frag")};
    auto translate = [&](const std::string& log) { return translate_link_log(log, stages, folder.path()); };

    // NVIDIA. Flat: #version, shade, tint.
    std::vector<ShaderError> errors =
        translate("Fragment info\n-------------\n0(2) : error C3001: no function \"shade\"\n"
                  "(0) : error C5041: cannot bind\nVertex info\n-----------\n"
                  "0(3) : error C3001: no such thing\n");
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_EQ(errors[0].text(), "lib.glsl:1: does not link: error C3001: no function \"shade\"\n    vec3 shade();");
    EXPECT_EQ(errors[1].text(), "main.frag: does not link: (0) : error C5041: cannot bind");
    EXPECT_EQ(errors[2].file, "main.vert");
    EXPECT_EQ(errors[2].line, 2);

    // Mesa names stages, and gives no lines.
    errors =
        translate("error: fragment shader input `tint' does not match vertex shader output\nwarning: never mind\n");
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].file, "main.frag");
    EXPECT_EQ(errors[0].line, 0);

    // A line of nobody knows which stage says nothing.
    errors = translate("ERROR: 0:2: too many varyings");
    EXPECT_EQ(errors.at(0).text(), "main.vert: does not link: too many varyings");
    EXPECT_THAT(translate("").at(0).text(), HasSubstr("main.vert: does not link"));
}

TEST_F(Source, StagesAreKnownByExtension) {
    EXPECT_EQ(stage_of("x/y.vert"), ShaderStage::vertex);
    EXPECT_EQ(stage_of("y.geom"), ShaderStage::geometry);
    EXPECT_THAT(error_of([] { stage_of("y.glsl"); }), HasSubstr("'y.glsl' is no shader stage"));
}
