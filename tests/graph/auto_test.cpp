// Values that follow what a scene needs: "auto" in graph files, on the command line, and through the graph's own
// parameters.
#include "graph/graph_test.h"

namespace bounce {

namespace {

struct AutoTest : PlanTest {
    GraphModel graph(const std::string& params) {
        shader("rays.comp", "uniform int rays = 16;  //! [1, 64] auto(cones) rays\n"
                            "uniform float share = 0.5;  //! [0, 1] a share\n"
                            "layout(FORMAT_a_out) writeonly uniform image2D a_out;");
        return model(R"("parameters":{"side":{"default":8,"choices":[4,8,16,32],"auto":"voxels"}},)"
                     R"("resources":{"a.out":{"size":["graph.side",8]}},)"
                     R"("passes":[{"id":"rays","type":"compute","shader":"rays.comp","dispatch":"a.out","params":{)" +
                     params + "}}]");
    }
    const SceneNeeds needs{{"voxels", {20, "gaps of 1 m"}}, {"cones", {40, "little is lit"}}};
};

} // namespace

TEST_F(AutoTest, AFileMayAskForIt) {
    GraphModel m = graph(R"("rays":"auto")");
    EXPECT_TRUE(m.has_auto(true));
    EXPECT_EQ(m.number("rays.rays"), 16) << "the default, while no scene is there";
    m.resolve_auto(needs);
    EXPECT_TRUE(m.has_auto());
    EXPECT_FALSE(m.has_auto(true));
    EXPECT_EQ(m.number("rays.rays"), 40);
    EXPECT_EQ(m.parameter("rays.rays").reason, "little is lit");
    EXPECT_EQ(m.parameter("rays.rays").origin, ParameterOrigin::graph);
    EXPECT_TRUE(m.values().parameters.empty()) << "it is the file's, not a person's";
}

TEST_F(AutoTest, WhatFollowsTheGraphFollowsIt) {
    GraphModel m = graph(R"("rays":"=graph.side * 2")");
    EXPECT_FALSE(m.has_auto());
    m.set("graph.side", "auto", ParameterOrigin::command_line);
    m.take_changes();
    m.resolve_auto(needs);
    EXPECT_EQ(m.number("graph.side"), 32) << "the step that is not below 20";
    EXPECT_EQ(m.number("rays.rays"), 64);
    EXPECT_THAT(m.take_changes(), testing::UnorderedElementsAre("graph.side", "rays.rays"));
    EXPECT_EQ(m.plan({}, {16, 16}).find_resource("a.out")->texture.size.x, 32);
    EXPECT_EQ(m.values().options(), "--set graph.side=auto");
    m.resolve_auto(needs);
    EXPECT_TRUE(m.take_changes().empty()) << "nothing has changed";
}

TEST_F(AutoTest, AGraphsOwnParameterMayHaveItAsItsDefault) {
    shader("a.comp", "layout(FORMAT_a_out) writeonly uniform image2D a_out;");
    const std::string passes = R"(,"resources":{"a.out":{"size":[8,8]}},)"
                               R"("passes":[{"id":"a","type":"compute","shader":"a.comp","dispatch":"a.out"}])";
    GraphModel m = model(R"("parameters":{"cells":{"default":"auto","range":[4,64],"auto":"voxels"},)"
                         R"("side":{"default":"auto","choices":[4,8,16,32],"auto":"voxels"}})" +
                         passes);
    EXPECT_TRUE(m.has_auto(true));
    EXPECT_EQ(m.parameter("graph.cells").info.kind, ParameterKind::integer);
    m.resolve_auto(needs);
    EXPECT_EQ(m.number("graph.cells"), 20);
    EXPECT_EQ(m.number("graph.side"), 32);
    EXPECT_TRUE(m.values().parameters.empty());
    m.set("graph.cells", "16", ParameterOrigin::panel);
    EXPECT_EQ(m.values().options(), "--set graph.cells=16") << "the middle of the range is no default to be left out";
    m.graph_parameters().reset("cells");
    EXPECT_TRUE(m.parameter("graph.cells").is_auto);
    EXPECT_THAT(error_of([&] { model(R"("parameters":{"cells":{"default":"auto","auto":"voxels"}})" + passes); }),
                testing::HasSubstr("needs a 'range'"));
}

TEST_F(AutoTest, AnotherModelTakesItOver) {
    GraphModel m = graph(R"("share":0.25)");
    m.set("rays.rays", "auto", ParameterOrigin::panel);
    m.resolve_auto(needs);
    GraphModel next = graph(R"("share":0.75)");
    next.adopt_values(m.values());
    EXPECT_TRUE(next.has_auto(true));
    next.resolve_auto({{"cones", {7, "much is lit"}}});
    EXPECT_EQ(next.number("rays.rays"), 7);
    next.set("rays.rays", "12", ParameterOrigin::panel);
    EXPECT_FALSE(next.has_auto());
}

TEST_F(AutoTest, OthersRefuseIt) {
    EXPECT_THAT(error_of([&] { graph(R"("share":"auto")"); }), testing::HasSubstr("'auto' is not a value"));
    GraphModel m = graph(R"("rays":4)");
    EXPECT_THAT(error_of([&] { m.set("rays.share", "auto", ParameterOrigin::panel); }), testing::HasSubstr("auto"));
}

} // namespace bounce
