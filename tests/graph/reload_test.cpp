// A running graph outlives every edit: the last good program and the last good plan stay.
#include "gpu/objects.h"
#include "graph/graph_test.h"

#include <cstdlib>
#include <iostream>
#include <malloc.h>

using namespace bounce;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

namespace {
const char* const k_graph =
    R"("resources":{"a.image":{"format":"rgba32f","size":[4,4]}},"passes":[{"id":"fill","type":"compute","shader":"fill.comp"}])";
}

class Reload : public GraphTest {
  protected:
    float red(const GraphRunner& run) { return run.read("a.image")[0]; }
    void next(GraphRunner& run) {
        run.graph.poll_files();
        run.frame();
    }
};

TEST_F(Reload, BrokenFixedBrokenFixed) {
    fill_shader("fill.comp", "a_image", "1");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    EXPECT_EQ(red(run), 1);
    fill_shader("fill.comp", "a_image", "undeclared");
    next(run);
    EXPECT_EQ(red(run), 1) << "the last good program stays";
    EXPECT_THAT(run.problems(), AllOf(HasSubstr("fill.comp:7: "), HasSubstr("undeclared"),
                                      HasSubstr("imageStore(a_image, p, vec4(undeclared));")));
    EXPECT_TRUE(run.graph.pass_is_stale("fill"));
    fill_shader("fill.comp", "a_image", "2");
    next(run);
    EXPECT_EQ(red(run), 2);
    EXPECT_EQ(run.problems(), "");
    EXPECT_FALSE(run.graph.pass_is_stale("fill"));
    root.save_by_rename("glsl/fill.comp", "oops");
    next(run);
    EXPECT_EQ(red(run), 2);
    EXPECT_NE(run.problems(), "");
    fill_shader("fill.comp", "a_image", "3");
    next(run);
    EXPECT_EQ(red(run), 3);
    EXPECT_EQ(run.problems(), "");
}

/// What a file that is not there would have added is nothing: the text is the same without the line that asks for it.
TEST_F(Reload, AnIncludeThatIsNotThereComesAndGoes) {
    fill_shader("fill.comp", "a_image", "1");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    const std::string whole = root.read("glsl/fill.comp");
    for (const char* line : {"#include \"none.glsl\"\n", "#include \"lib/none.glsl\"\n", "#include none\n"}) {
        root.write("glsl/fill.comp", line + whole);
        next(run);
        EXPECT_THAT(run.problems(), HasSubstr("fill.comp:1: ")) << line;
        EXPECT_EQ(red(run), 1);
        root.write("glsl/fill.comp", whole);
        next(run);
        EXPECT_EQ(run.problems(), "") << line;
        EXPECT_FALSE(run.graph.pass_is_stale("fill"));
        EXPECT_EQ(red(run), 1);
    }
}

/// A new plan (a slider, a resize) reads the shaders again; the text that is wrong is still wrong.
TEST_F(Reload, AnErrorStaysUntilItsTextChanges) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    fill_shader("fill.comp", "a_image", "gain + undeclared", "uniform float gain = 1.0; //! [0, 9] gain");
    next(run);
    EXPECT_THAT(run.problems(), HasSubstr("undeclared"));
    run.graph.model().set("fill.gain", "5", ParameterOrigin::panel);
    run.graph.touch();
    run.frame();
    EXPECT_EQ(red(run), 5);
    EXPECT_THAT(run.problems(), HasSubstr("undeclared"));
    EXPECT_TRUE(run.graph.pass_is_stale("fill"));
    run.size = {32, 32};
    run.frame();
    EXPECT_THAT(run.problems(), HasSubstr("undeclared"));
}

TEST_F(Reload, ABrokenIncludeBreaksBothThatShareIt) {
    root.write("glsl/lib/shared.glsl", "float shared_value() { return 4.0; }\n");
    fill_shader("fill.comp", "a_image", "shared_value()", "#include \"lib/shared.glsl\"");
    fill_shader("other.comp", "a_other", "10.0 * shared_value()", "#include \"lib/shared.glsl\"");
    GraphRunner run(graph_file(R"("resources":{"a.image":{"format":"rgba32f"},"a.other":{"format":"rgba32f"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},{"id":"other","type":"compute","shader":"other.comp"}])"));
    run.frame();
    root.write("glsl/lib/shared.glsl", "// one line more\nfloat shared_value() { return nonsense; }\n");
    next(run);
    std::set<std::string> broken;
    for (const GraphProblem& problem : run.graph.problems())
        broken.insert(problem.where);
    EXPECT_THAT(broken, testing::ElementsAre("pass fill", "pass other"));
    for (const GraphProblem& problem : run.graph.problems()) {
        EXPECT_EQ(problem.error.file, "lib/shared.glsl");
        EXPECT_EQ(problem.error.line, 2);
        EXPECT_EQ(problem.error.source_line, "float shared_value() { return nonsense; }");
    }
    EXPECT_EQ(red(run), 4);
    root.write("glsl/lib/shared.glsl", "float shared_value() { return 5.0; }\n");
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 5);
    EXPECT_EQ(run.read("a.other")[0], 50);
}

TEST_F(Reload, AnIncludeThatVanishesAndComesBack) {
    root.write("glsl/lib/shared.glsl", "float shared_value() { return 4.0; }\n");
    fill_shader("fill.comp", "a_image", "shared_value()", "#include \"lib/shared.glsl\"");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    root.remove("glsl/lib/shared.glsl");
    next(run);
    EXPECT_EQ(red(run), 4);
    EXPECT_THAT(run.problems(), AllOf(HasSubstr("fill.comp:2: "), HasSubstr("shared.glsl"), HasSubstr("#include")));
    root.write("glsl/lib/shared.glsl", "float shared_value() { return 6.0; }\n");
    next(run);
    EXPECT_EQ(red(run), 6);
    EXPECT_EQ(run.problems(), "");
}

TEST_F(Reload, AWholeShaderThatVanishesAndComesBackKeepsItsValues) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    run.graph.model().set("fill.gain", "5", ParameterOrigin::command_line);
    root.remove("glsl/fill.comp");
    next(run);
    EXPECT_NE(run.problems(), "");
    EXPECT_EQ(red(run), 5) << "the last good plan and program go on";
    fill_shader("fill.comp", "a_image", "gain * 10", "uniform float gain = 1.0; //! [0, 9] gain");
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 50);
}

TEST_F(Reload, BrokenAtStartShowsMagentaAndNeutralUntilFixed) {
    shader("fill.comp", "layout(FORMAT_a_image) writeonly uniform image2D a_image;\nlayout(FORMAT_a_count) writeonly "
                        "uniform uimage2D a_count;\nvoid main() { nonsense; }\n");
    GraphRunner run(graph_file(R"("resources":{"a.image":{"format":"rgba32f"},"a.count":{"format":"r32ui","neutral":3}},
                               "passes":[{"id":"fill","type":"compute","shader":"fill.comp"}])"));
    run.frame();
    EXPECT_THAT(std::vector<float>(run.read("a.image")).front(), 1);
    EXPECT_EQ(run.read("a.image")[1], 0);
    EXPECT_EQ(run.read("a.image")[2], 1);
    EXPECT_THAT(run.read("a.count"), Each(3));
    EXPECT_NE(run.problems(), "");
    fill_shader("fill.comp", "a_image", "2", "layout(FORMAT_a_count) writeonly uniform uimage2D a_count;");
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 2);
}

TEST_F(Reload, ANewParameterAppearsWithItsRangeAndValuesSurviveByNameAndType) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    run.graph.model().set("fill.gain", "7", ParameterOrigin::panel);
    fill_shader("fill.comp", "a_image", "gain + bias",
                "uniform float gain = 1.0; //! [0, 9] gain\nuniform int bias = 2; //! [1, 3] (steps) added");
    next(run);
    EXPECT_EQ(red(run), 9);
    const Parameter& bias = run.graph.model().parameter("fill.bias");
    EXPECT_EQ(range_text(bias.info), "[1, 3]");
    EXPECT_EQ(bias.info.unit, "steps");
    EXPECT_EQ(bias.info.help, "added");
    fill_shader("fill.comp", "a_image", "gain + bias",
                "uniform int gain = 1; //! [0, 9] gain\nuniform int bias = 2; //! [1, 3] added");
    next(run);
    EXPECT_EQ(red(run), 3) << "of another type: its default";
    fill_shader("fill.comp", "a_image", "0.5");
    next(run);
    EXPECT_THAT(run.graph.model().parameter_names(), Not(testing::Contains("fill.gain")));
}

TEST_F(Reload, AStaticParameterIsCompiledInAndRecompiledWhenItChanges) {
    fill_shader("fill.comp", "a_image", "sum()",
                "uniform int steps = 2; //! static [1, 8] steps\nfloat sum() { float a[steps]; float s = 0.0; for (int "
                "i = 0; i < steps; ++i) { a[i] = 1.0; s += a[i]; } return s; }");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 2);
    GLuint before = run.graph.model().nodes()[0]->programs[0]->id();
    run.graph.model().set("fill.steps", "6", ParameterOrigin::panel);
    run.graph.touch();
    run.frame();
    EXPECT_EQ(red(run), 6);
    EXPECT_NE(run.graph.model().nodes()[0]->programs[0]->id(), before);
}

/// A pass that reads a resource at one value of a static parameter only needs it there only; a pass that shares the
/// parameter follows.
TEST_F(Reload, AStaticBoolBringsASlotAndTakesItAway) {
    const char* const k_choice = "uniform bool other = false; //! static other\n#if other\nuniform sampler2D a_other;\n"
                                 "float value() { return texelFetch(a_other, ivec2(0), 0).r; }\n#else\n"
                                 "float value() { return 3.0; }\n#endif";
    fill_shader("fill.comp", "a_image", "value()", k_choice);
    fill_shader("same.comp", "a_same", "value() + 1.0", k_choice);
    fill_shader("late.comp", "a_other", "5.0", "uniform sampler2D a_image;\nuniform sampler2D a_same;");
    // Only without a.other, which comes from what they feed, is this no circle.
    auto file = graph_file(R"("resources":{"a.image":{"format":"rgba32f","size":[4,4]},
        "a.same":{"format":"rgba32f","size":[4,4]},"a.other":{"format":"rgba32f","size":[4,4]}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},
                  {"id":"same","type":"compute","shader":"same.comp","params_of":"fill"},
                  {"id":"late","type":"compute","shader":"late.comp"}])");
    GraphRunner run(file);
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 3);
    EXPECT_EQ(run.read("a.same")[0], 4);
    EXPECT_THAT(run.graph.model().parameter_names(), Not(testing::Contains("same.other"))) << "it is the other's";
    EXPECT_THROW(
        {
            run.graph.model().set("fill.other", "true", ParameterOrigin::panel);
            run.graph.model().plan({}, {4, 4});
        },
        Error)
        << "both read what late makes of them";
    run.graph.model().set("fill.other", "false", ParameterOrigin::panel);
    run.graph.touch();
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 3);
}

TEST_F(Reload, AGraphFileEditedWhileRunning) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    fill_shader("more.comp", "a_more", "texelFetch(a_image, ivec2(0), 0).r * 10", "uniform sampler2D a_image;");
    auto file = graph_file(k_graph);
    GraphRunner run(file);
    run.frame();
    GLuint program = run.graph.model().find_node("fill")->programs[0]->id();
    run.graph.model().set("fill.gain", "4", ParameterOrigin::panel);
    std::string more =
        R"("resources":{"a.image":{"format":"rgba32f","size":[4,4]},"a.more":{"format":"r32f","size":[2,2]}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},{"id":"more","type":"compute","shader":"more.comp"}])";
    graph_file(more);
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.read("a.more")[0], 40) << "a compute pass dropped in, values kept";
    EXPECT_EQ(run.graph.model().find_node("fill")->programs[0]->id(), program) << "not compiled again";

    for (
        const char* bad :
        {R"("passes":[{)", R"("passes":[{"id":"fill","type":"nonsense"}])",
         R"("passes":[{"id":"more","type":"compute","shader":"more.comp"}])",
         R"("resources":{"a.image":{"format":"rgba32f","size":[100000,100000]}},"passes":[{"id":"fill","type":"compute","shader":"fill.comp"}])",
         R"("resources":{"a.image":{"format":"rgba32f"}},"passes":[{"id":"fill","type":"compute","shader":"fill.comp","dispatch":["nonsense"]}])"}) {
        graph_file(bad);
        next(run);
        EXPECT_EQ(run.graph.plan().passes.size(), 2u) << bad;
        EXPECT_EQ(run.read("a.more")[0], 40) << bad;
        EXPECT_NE(run.problems(), "") << bad;
        run.frame(2); // and it goes on
    }
    graph_file(k_graph);
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.graph.plan().passes.size(), 1u);
    EXPECT_EQ(red(run), 4);
}

/// The files of a chain are watched, all of them, also those that a broken one names.
TEST_F(Reload, ABaseEditedWhileAGraphThatExtendsItRuns) {
    fill_shader("fill.comp", "a_image", "gain + more",
                "uniform float gain = 1.0; //! [0, 9] gain\nuniform float more = 0.0; //! [0, 9] more");
    auto base = [&](const std::string& gain) {
        root.write("assets/graphs/base.json",
                   R"({"version":1,"resources":{"a.image":{"format":"rgba32f","size":[4,4]}},"passes":)"
                   R"([{"id":"fill","type":"compute","shader":"fill.comp","params":{"gain":)" +
                       gain + "}}]}");
    };
    auto middle = [&](const std::string& of) {
        root.write("assets/graphs/middle.json", R"({"version":1,"extends":")" + of + "\"}");
    };
    base("2");
    middle("base");
    GraphRunner run(graph_file(R"("extends":"middle","passes":[{"id":"fill","params":{"more":5}}])"));
    run.frame();
    EXPECT_EQ(red(run), 7);
    base("3");
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 8);
    base("\"three\"");
    next(run);
    EXPECT_THAT(run.problems(), HasSubstr("gain"));
    EXPECT_EQ(red(run), 8) << "the last good graph stays";
    root.remove("assets/graphs/base.json");
    next(run);
    EXPECT_THAT(run.problems(), HasSubstr("there is no graph 'base' to extend"));
    base("4");
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 9) << "it came back";
    root.write("assets/graphs/other.json", "{");
    middle("other");
    next(run);
    EXPECT_THAT(run.problems(), HasSubstr("other.json:1: not valid JSON"));
    EXPECT_EQ(red(run), 9);
    root.write("assets/graphs/other.json",
               R"({"version":1,"extends":"base","passes":[{"id":"fill","params":{"gain":1}}]})");
    next(run);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(red(run), 6) << "a file that only the broken graph named was mended";
}

TEST_F(Reload, AProgramThatHungTheGpuStaysDisabledUntilItIsEdited) {
    fill_shader("fill.comp", "a_image", "2");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    fill_shader("fill.comp", "a_image", "4");
    next(run);
    EXPECT_EQ(red(run), 4);
    run.graph.release_gpu();
    run.graph.restore_gpu(ResetCause::guilty);
    run.frame();
    EXPECT_EQ(run.read("a.image")[1], 0) << "magenta";
    EXPECT_THAT(run.problems(), HasSubstr("disabled: the GPU was reset, and it was compiled last"));
    run.graph.touch();
    run.frame();
    EXPECT_EQ(run.read("a.image")[1], 0) << "a new plan does not bring it back";
    fill_shader("fill.comp", "a_image", "3");
    next(run);
    EXPECT_EQ(red(run), 3);
    EXPECT_EQ(run.problems(), "");
}

/// BOUNCE_RELOADS=10000 does as many; a few are enough to see what each of them leaves behind.
TEST_F(Reload, TenThousandReloadsLeaveNothingBehind) {
    const char* asked = std::getenv("BOUNCE_RELOADS");
    const int reloads = asked ? std::max(40, std::atoi(asked)) : 300;
    fill_shader("fill.comp", "a_image", "1");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    size_t bytes = 0;
    int objects = 0;
    int names = 0;
    for (int i = 0; i < reloads; ++i) {
        // Good, broken for the compiler, broken for ours, and other parameters, in turn.
        const int kind = i % 5;
        if (kind == 3)
            root.write("glsl/fill.comp", std::string("uniform float bad = 1.0; //! [2, 0] bad\n"));
        else
            fill_shader("fill.comp", "a_image",
                        kind == 1   ? "undeclared"
                        : kind == 2 ? "gain"
                                    : std::to_string(kind),
                        kind == 2 ? "uniform float gain = 7.0; //! [0, 9] gain" : "");
        next(run);
        EXPECT_EQ(run.problems().empty(), kind != 1 && kind != 3) << run.problems();
        EXPECT_EQ(red(run), kind == 4 ? 4 : kind == 0 || kind == 1 ? 0 : 7) << i;
        if (i != reloads / 4 && i + 1 != reloads) continue;
        glFinish();
        // A driver need not use names again, so what counts are those that are in use.
        const GLuint end = glCreateProgram();
        glDeleteProgram(end);
        int now = 0;
        for (GLuint name = 1; name < end; ++name)
            now += glIsProgram(name) || glIsShader(name);
        if (i + 1 < reloads) {
            bytes = mallinfo2().uordblks, objects = live_objects().total(), names = now;
            continue;
        }
        EXPECT_EQ(live_objects().total(), objects);
        EXPECT_LE(now, names + 2) << "programs and shaders are deleted";
        const double grown = double(mallinfo2().uordblks) - double(bytes);
        std::cout << "grown by " << grown << " bytes in " << reloads - reloads / 4 << " reloads\n";
        EXPECT_LT(grown, 1 << 20);
    }
}

TEST_F(Reload, UniformsWithoutSourceAreAnError) {
    fill_shader("fill.comp", "a_image", "stranger + resolution.x",
                "uniform float stranger;\nuniform ivec3 resolution;");
    GraphRunner run(graph_file(k_graph));
    run.frame();
    EXPECT_THAT(run.problems(), AllOf(HasSubstr("uniform 'stranger' has no source"),
                                      HasSubstr("'resolution' is a constant of the frame, of another type")));
}
