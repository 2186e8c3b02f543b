// What runs again, what stands, and what is forgotten: by what really reaches a pass.
#include "graph/graph_test.h"

using namespace bounce;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class Invalidations : public GraphTest {
  protected:
    /// a.image = `gain`; a.mean counts the frames since it was cleared, whatever `input`, which is not negative, is:
    /// the compiler does not know that.
    GraphRunner counting(const std::string& input = "1.0", const std::string& declarations = "") {
        fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
        shader("count.comp",
               "layout(local_size_x = 1) in;\nuniform sampler2D a_image;\n"
               "layout(r32f) uniform image2D a_mean;\nuniform float weight = 1.0; //! [0, 9] weight\n" +
                   declarations +
                   "\nvoid main() { float seen = min(texelFetch(a_image, ivec2(0), 0).r, 0.0);\n"
                   "imageStore(a_mean, ivec2(0), imageLoad(a_mean, ivec2(0)) + 1.0 + min(weight, 0.0) + seen + min(" +
                   input + ", 0.0)); }\n");
        fill_shader("other.comp", "a_other", "tint", "uniform float tint = 1.0; //! [0, 9] tint");
        return GraphRunner(graph_file(
            R"("resources":{"a.image":{"format":"rgba32f","size":[4,4]},"a.other":{"format":"rgba32f","size":[4,4]},
                            "a.mean":{"format":"r32f","size":[1,1],"persistent":true}},
               "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},
                         {"id":"count","type":"compute","shader":"count.comp","dispatch":[1]},
                         {"id":"other","type":"compute","shader":"other.comp"}])"));
    }
    static void on_change(GraphRunner& run) {
        run.graph.model().set("graph.rebuild", "on_change", ParameterOrigin::panel);
    }
    static void set(GraphRunner& run, const std::string& name, const std::string& text) {
        run.graph.model().set(name, text, ParameterOrigin::panel);
    }
    /// Ids of the passes that ran in the newest frame.
    static std::vector<std::string> ran(const GraphRunner& run) {
        std::vector<std::string> ids;
        for (const PlanPass& pass : run.graph.plan().passes)
            if (!run.graph.timing(pass.id).unchanged) ids.push_back(pass.id);
        return ids;
    }
};

} // namespace

// --- what earlier frames left
// ------------------------------------------------------------------------------------------

TEST_F(Invalidations, APersistentResourceIsForgottenWhenWhatReachesItChanges) {
    GraphRunner run = counting();
    auto mean = [&] { return run.read("a.mean")[0]; };
    run.frame(3);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(mean(), 3);
    set(run, "other.tint", "2"); // does not reach it
    run.frame();
    EXPECT_EQ(mean(), 4);
    set(run, "count.weight", "2"); // its maker's
    run.frame();
    EXPECT_EQ(mean(), 1);
    set(run, "fill.gain", "2"); // of what its maker reads
    run.frame(2);
    EXPECT_EQ(mean(), 2);
    root.edit("glsl/fill.comp", "vec4(gain)", "vec4(gain * 2.0)");
    run.graph.poll_files();
    run.frame();
    EXPECT_EQ(mean(), 1) << "another program before it";
    run.frame();
    root.edit("glsl/other.comp", "vec4(tint)", "vec4(tint * 2.0)");
    run.graph.poll_files();
    run.frame();
    EXPECT_EQ(mean(), 3) << "another program beside it";
    root.edit("glsl/fill.comp", "gain * 2.0", "undeclared");
    run.graph.poll_files();
    run.frame();
    EXPECT_EQ(mean(), 4) << "the last good program stays, and with it what it made";
    run.graph.reset_history();
    run.frame();
    EXPECT_EQ(mean(), 1) << "a camera cut";
}

/// The view moves: what cannot follow is forgotten; what knows where the camera was (by reflection) is not.
TEST_F(Invalidations, AMovedCameraResetsWhatDoesNotFollowIt) {
    for (bool follows : {false, true}) {
        GraphRunner run =
            counting(follows ? "(view_projection[3].x + previous_view_projection[3].x)" : "view_projection[3].x",
                     "uniform mat4 view_projection, previous_view_projection;");
        run.frame(3);
        EXPECT_EQ(run.problems(), "");
        run.constants.view_projection[3].x = 2;
        run.frame();
        EXPECT_EQ(run.read("a.mean")[0], follows ? 4 : 1);
    }
}

/// It declares all of the frame's constants and uses none that changes.
TEST_F(Invalidations, OnlyConstantsThatAProgramReallyUsesReachIt) {
    GraphRunner run = counting("float(resolution.x)", "uniform mat4 view_projection;\nuniform ivec2 resolution;\n"
                                                      "uniform int frame_index;\nuniform float time;");
    run.frame(3);
    run.constants.view_projection[3].x = 2;
    run.constants.time = 5;
    run.frame();
    EXPECT_EQ(run.read("a.mean")[0], 4);
}

/// What is kept may depend on another pass by last frame's copy alone, and on itself.
TEST_F(Invalidations, ChangesReachThroughLastFramesCopy) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    fill_shader("sum.comp", "a_sum", "texelFetch(a_sum_before, p, 0).r + texelFetch(a_image_before, p, 0).r",
                "uniform sampler2D a_sum_before;\nuniform sampler2D a_image_before;");
    GraphRunner run(graph_file(R"-("resources":{"a.image":{"format":"rgba32f"},"a.sum":{"format":"rgba32f"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},
                  {"id":"sum","type":"compute","shader":"sum.comp",
                   "bind":{"a.sum_before":"previous(a.sum)","a.image_before":"previous(a.image)"}}])-"));
    auto sum = [&] { return run.read("a.sum")[0]; };
    run.frame(4);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(sum(), 3);
    set(run, "fill.gain", "5");
    run.frame();
    EXPECT_EQ(sum(), 0) << "neither the sum nor the picture before is of this graph";
    run.frame(2);
    EXPECT_EQ(sum(), 10);
}

TEST_F(Invalidations, AValueThatIsChangedBackGivesTheSameBytesAsAFreshStart) {
    GraphRunner run = counting();
    run.frame(2);
    set(run, "fill.gain", "3");
    run.frame();
    set(run, "fill.gain", "1");
    run.frame();
    EXPECT_EQ(run.read("a.mean")[0], 1);
    EXPECT_EQ(run.read("a.image")[0], 1);
}

// --- what runs
// ---------------------------------------------------------------------------------------------------------

TEST_F(Invalidations, OnChangeNothingIsComputedTwice) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    fill_shader("next.comp", "a_next", "texelFetch(a_image, p, 0).r * 10", "uniform sampler2D a_image;");
    fill_shader("timed.comp", "a_timed", "frame_index", "uniform int frame_index;");
    fill_shader("other.comp", "a_other", "tint", "uniform float tint = 1.0; //! [0, 9] tint");
    GraphRunner run(graph_file(R"("resources":{"a.image":{"format":"rgba32f"},"a.next":{"format":"rgba32f"},
        "a.timed":{"format":"rgba32f"},"a.other":{"format":"rgba32f"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},{"id":"next","type":"compute","shader":"next.comp"},
                  {"id":"timed","type":"compute","shader":"timed.comp"},{"id":"other","type":"compute","shader":"other.comp"}])"));
    run.frame(2);
    EXPECT_THAT(ran(run), ElementsAre("fill", "next", "timed", "other")) << "every_frame";
    on_change(run);
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("timed"));
    EXPECT_GT(run.graph.timing("fill").last, 0) << "the cost of its last run";
    set(run, "fill.gain", "3");
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("fill", "next", "timed"));
    EXPECT_EQ(run.read("a.next")[0], 30);
    set(run, "fill.gain", "3");
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("timed")) << "the same value again";
    root.edit("glsl/next.comp", "* 10", "* 20");
    run.graph.poll_files();
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("next", "timed"));
    EXPECT_EQ(run.read("a.next")[0], 60);
    run.graph.touch();
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("timed")) << "a new plan of the same shape";
    run.size = {20, 10};
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("fill", "next", "timed", "other")) << "other pictures";
    EXPECT_EQ(run.read("a.next").size(), 4u * 200);
}

/// Passes that write into one resource: if one runs, so do all, in order, from the cleared state on; and whoever reads
/// what lay there between them finds it again.
TEST_F(Invalidations, AResourceThatSeveralPassesWriteIsMadeFromItsStart) {
    auto adds = [&](const std::string& name, float value) {
        shader(name + ".comp", "layout(local_size_x = 1) in;\nlayout(r32f) uniform image2D a_sum;\nuniform float " +
                                   name +
                                   "_gain = 1.0; //! [0, 9] gain\nvoid main() { imageStore(a_sum, ivec2(0), "
                                   "imageLoad(a_sum, ivec2(0)) * 10.0 + " +
                                   std::to_string(value) + " * " + name + "_gain); }\n");
    };
    adds("one", 1), adds("two", 2), adds("three", 3);
    fill_shader("between.comp", "a_between", "texelFetch(a_sum, ivec2(0), 0).r + min(shift, 0.0)",
                "uniform sampler2D a_sum;\nuniform float shift = 0.0; //! [0, 9] shift");
    fill_shader("after.comp", "a_after", "texelFetch(a_sum, ivec2(0), 0).r + min(shift, 0.0)",
                "uniform sampler2D a_sum;\nuniform float shift = 0.0; //! [0, 9] shift");
    GraphRunner run(graph_file(R"("resources":{"a.sum":{"format":"r32f","size":[1,1]},
        "a.between":{"format":"r32f","size":[1,1]},"a.after":{"format":"r32f","size":[1,1]}},
        "passes":[{"id":"one","type":"compute","shader":"one.comp","dispatch":[1]},
                  {"id":"between","type":"compute","shader":"between.comp"},
                  {"id":"two","type":"compute","shader":"two.comp","dispatch":[1]},
                  {"id":"three","type":"compute","shader":"three.comp","dispatch":[1]},
                  {"id":"after","type":"compute","shader":"after.comp"}])"));
    auto values = [&] { return std::vector<float>{run.read("a.between")[0], run.read("a.after")[0]}; };
    run.frame();
    EXPECT_EQ(run.problems(), "");
    std::vector<float> first = values();
    on_change(run);
    run.frame(2);
    EXPECT_THAT(ran(run), ElementsAre());
    EXPECT_EQ(values(), first);
    set(run, "three.three_gain", "2");
    run.frame();
    EXPECT_EQ(values(), (std::vector<float>{first[0], first[1] + 3}));
    set(run, "three.three_gain", "1");
    run.frame();
    EXPECT_EQ(values(), first);
    set(run, "after.shift", "1");
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("after")) << "what it reads lies there";
    EXPECT_EQ(values(), first);
    set(run, "between.shift", "1");
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("one", "between", "two", "three")) << "what it reads has been written over";
    EXPECT_EQ(values(), first);
}

/// A structure that is built in batches: a consumer that changes needs all of them again, one that does not is left.
TEST_F(Invalidations, ALoopOfBatchesIsTakenAgainForOneConsumer) {
    shader("build.comp", "layout(local_size_x = 1) in;\nlayout(std430) buffer test_batch { uint batch[]; };\n"
                         "uniform int iteration;\nvoid main() { batch[0] = uint(iteration + 1); }\n");
    for (const char* name : {"use", "view"})
        shader(std::string(name) + ".comp",
               "layout(local_size_x = 1) in;\nlayout(std430) readonly buffer test_batch { uint batch[]; };\n"
               "layout(std430) buffer test_" +
                   std::string(name) + " { uint sum[]; };\nuniform int gain = 1; //! [1, 9] gain\n" +
                   "uniform int iteration;\nvoid main() { if (iteration == 0) sum[0] = 0u;\n"
                   "sum[0] = sum[0] * 10u + batch[0] * uint(gain); }\n");
    for (int batches : {3, 1}) {
        std::string loop =
            R"("repeat":{"over":"count","count":")" + std::to_string(batches) + R"(","loop":"batches"}})";
        std::string common = R"(,"type":"compute","dispatch":[1],)";
        GraphRunner run(graph_file(
            R"("resources":{"test.batch":{"kind":"buffer","count":1,"stride":4},"test.use":{"kind":"buffer","count":1,"stride":4},
                            "test.view":{"kind":"buffer","count":1,"stride":4}},
               "passes":[{"id":"build","shader":"build.comp")" +
            common + loop + R"(,{"id":"use","shader":"use.comp")" + common + loop +
            R"(,{"id":"view","shader":"view.comp")" + common + loop + "]"));
        on_change(run);
        run.frame();
        EXPECT_EQ(run.problems(), "");
        uint32_t sum = batches == 3 ? 123 : 1;
        EXPECT_THAT(run.read_buffer<uint32_t>("test.use"), ElementsAre(sum));
        run.frame();
        EXPECT_THAT(ran(run), ElementsAre());
        set(run, "view.gain", "2");
        run.frame();
        if (batches > 1)
            EXPECT_THAT(ran(run), ElementsAre("build", "view"));
        else
            EXPECT_THAT(ran(run), ElementsAre("view")) << "the one batch stands";
        EXPECT_THAT(run.read_buffer<uint32_t>("test.view"), ElementsAre(2 * sum));
        EXPECT_THAT(run.read_buffer<uint32_t>("test.use"), ElementsAre(sum));
    }
}

/// As long as history grows, its pass runs; where it stands, what reads last frame's copy stops one frame later.
TEST_F(Invalidations, HistoryRunsOnAndLastFramesCopyFollows) {
    fill_shader("fill.comp", "a_image", "gain", "uniform float gain = 1.0; //! [0, 9] gain");
    fill_shader("late.comp", "a_late", "texelFetch(a_before, p, 0).r", "uniform sampler2D a_before;");
    fill_shader("count.comp", "a_count", "texelFetch(a_count_before, p, 0).r + 1.0",
                "uniform sampler2D a_count_before;");
    GraphRunner run(graph_file(
        R"-("resources":{"a.image":{"format":"rgba32f"},"a.late":{"format":"rgba32f"},"a.count":{"format":"rgba32f"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},
                  {"id":"late","type":"compute","shader":"late.comp","bind":{"a.before":"previous(a.image)"}},
                  {"id":"count","type":"compute","shader":"count.comp","bind":{"a.count_before":"previous(a.count)"}}])-"));
    on_change(run);
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.read("a.late")[0], 0);
    run.frame();
    EXPECT_THAT(ran(run), ElementsAre("late", "count"));
    EXPECT_EQ(run.read("a.late")[0], 1);
    run.frame(3);
    EXPECT_THAT(ran(run), ElementsAre("count"));
    EXPECT_EQ(run.read("a.count")[0], 5);
}

/// Its program never compiled: magenta stands until it does.
TEST_F(Invalidations, AFailedPassIsMendedOnChange) {
    fill_shader("fill.comp", "a_image", "undeclared");
    GraphRunner run(graph_file(
        R"("resources":{"a.image":{"format":"rgba32f"}},"passes":[{"id":"fill","type":"compute","shader":"fill.comp"}])"));
    on_change(run);
    run.frame(2);
    EXPECT_EQ(run.read("a.image")[1], 0) << "magenta";
    fill_shader("fill.comp", "a_image", "2");
    run.graph.poll_files();
    run.frame();
    EXPECT_EQ(run.read("a.image")[1], 2);
    run.graph.model().find_node("fill")->enabled = false;
    run.frame();
    run.graph.model().find_node("fill")->enabled = true;
    run.frame();
    EXPECT_EQ(run.read("a.image")[1], 2) << "made anew after it was off";
}

// --- what is planned
// ---------------------------------------------------------------------------------------------------

/// Files are changed behind the graph's back: what does not read them shows the old text.
TEST_F(Invalidations, AUniformNeitherPlansNorReadsAFile) {
    fill_shader("fill.comp", "a_image", "gain * float(steps)",
                "uniform float gain = 1.0; //! [0, 9] gain\nuniform int steps = 1; //! static [1, 9] steps\n"
                "uniform int side = 4; //! [1, 16] side");
    fill_shader("other.comp", "a_other", "1.0");
    GraphRunner run(graph_file(R"("parameters":{"scale":{"default":1,"range":[1,4]}},
        "resources":{"a.image":{"format":"rgba32f","size":["fill.side * graph.scale",4]},"a.other":{"format":"rgba32f"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},{"id":"other","type":"compute","shader":"other.comp"}])"));
    run.frame();
    EXPECT_EQ(run.graph.plans(), 1u);
    std::string text = root.read("glsl/other.comp");
    root.write("glsl/other.comp", "nonsense");
    set(run, "fill.gain", "3");
    run.frame();
    EXPECT_EQ(run.graph.plans(), 1u);
    EXPECT_EQ(run.read("a.image")[0], 3);
    GLuint other = run.graph.model().find_node("other")->programs[0]->id();
    set(run, "fill.steps", "2");
    run.frame();
    EXPECT_EQ(run.read("a.image")[0], 6) << "compiled again";
    set(run, "fill.side", "8");
    run.frame();
    EXPECT_EQ(run.read("a.image").size(), 4u * 8 * 4) << "a uniform that a size uses plans";
    set(run, "graph.scale", "2");
    run.frame();
    EXPECT_EQ(run.read("a.image").size(), 4u * 16 * 4);
    EXPECT_EQ(run.problems(), "") << "nobody read the other's file";
    EXPECT_EQ(run.graph.model().find_node("other")->programs[0]->id(), other);
    root.write("glsl/other.comp", text);
}

TEST_F(Invalidations, RebuildIsEveryGraphsAndNoFilesParameter) {
    fill_shader("fill.comp", "a_image", "1.0");
    std::string error = error_of([&] {
        GraphRunner run(
            graph_file(R"("parameters":{"rebuild":{"default":1}},"resources":{"a.image":{"format":"rgba32f"}},
            "passes":[{"id":"fill","type":"compute","shader":"fill.comp"}])"));
    });
    EXPECT_THAT(error, HasSubstr("'rebuild' is a parameter that every graph has"));
}

/// Values and switches that a person set, of which one is the default again, survive the graph that they were set in.
TEST_F(Invalidations, ValuesMoveToAnotherGraph) {
    fill_shader("fill.comp", "a_image", "gain + shift",
                "uniform float gain = 1.0; //! [0, 9] gain\nuniform float shift = 0.0; //! [0, 9] shift");
    fill_shader("other.comp", "a_other", "1.0");
    auto file = graph_file(R"("resources":{"a.image":{"format":"rgba32f"},"a.other":{"format":"rgba32f"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp","params":{"gain":4}},
                  {"id":"other","type":"compute","shader":"other.comp","enabled":false}])");
    GraphModel first(read_graph_file(file)), second(read_graph_file(file));
    first.set("fill.gain", "1", ParameterOrigin::panel); // its default, not the file's
    first.set("fill.shift", "2", ParameterOrigin::command_line);
    first.switch_pass("other", true);
    EXPECT_EQ(first.values().options(), "--set fill.gain=1 --set fill.shift=2 --enable other");
    second.adopt_values(first.values());
    EXPECT_EQ(second.values().options(), first.values().options());
    EXPECT_EQ(second.parameter("fill.shift").origin, ParameterOrigin::command_line);
    root.edit("glsl/fill.comp", "uniform float shift = 0.0; //! [0, 9]", "uniform float shift = 0.0; //! [0, 1]");
    root.edit("glsl/fill.comp", "uniform float gain = 1.0; //!", "uniform int gain = 1; //!");
    GraphModel third(read_graph_file(file));
    third.adopt_values(first.values());
    EXPECT_EQ(third.values().options(), "--enable other") << "out of the new range, of another type";
}
