// Passes of a loop take their steps together; passes that had too little room are planned again.
#include "graph/graph_test.h"

#include "graph/context.h"
#include "graph/plan.h"

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

/// Wants to hold `items` numbers, and has room for one more than it was last told of.
class CratePass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.parameters.add("items", items_, {1, 64}, "", "how many it wants to hold");
    }
    void declare(Declaration& d) override {
        d.creates_buffer("crate.items", std::to_string(room_), 4);
        d.creates_buffer("crate.counts", "2", 4);
        d.writes("crate.items", Usage::storage);
        d.writes("crate.counts", Usage::storage);
        d.counts("items", "crate.counts", 0);
        d.counts("dropped items", "crate.counts", 1, true);
    }
    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        told.push_back(counted);
        if (counted[1] <= 0) return false;
        room_ = int(std::min<int64_t>(counted[0], 2 * room_)); // needs several tries
        return true;
    }
    void execute(PassContext& c) override {
        int32_t counts[2] = {items_, std::max(items_ - room_, 0)};
        c.buffer("crate.counts").update(0, sizeof(counts), counts);
    }
    static inline std::vector<std::vector<int64_t>> told;

  private:
    int items_ = 5, room_ = 1;
};

BOUNCE_REGISTER_PASS("test_crate", CratePass, "for tests")

class Loops : public GraphTest {
  protected:
    /// Writes its number and the step into a log.
    void logger(const std::string& name, int number) const {
        shader(name, "layout(local_size_x = 1) in;\nlayout(std430) buffer test_log { int log[]; };\n"
                     "uniform int iteration;\nvoid main() { log[++log[0]] = " +
                         std::to_string(10 * number) + " + iteration; }\n");
    }
    static std::string node(const std::string& id, const std::string& repeat) {
        return "{\"id\":\"" + id + "\",\"type\":\"compute\",\"shader\":\"" + id + ".comp\",\"dispatch\":[1]" +
               (repeat.empty() ? "" : ",\"repeat\":" + repeat) + "}";
    }
    static std::string loop(const std::string& count, const std::string& from = "0",
                            const std::string& name = "together") {
        return R"({"over":"count","count":")" + count + R"(","from":")" + from + R"(","loop":")" + name + "\"}";
    }
    static std::string graph(const std::string& passes) {
        return R"("resources":{"test.log":{"kind":"buffer","count":64,"stride":4}},"passes":[)" + passes + "]";
    }
    static std::vector<int> logged(const GraphRunner& run) {
        std::vector<int> log = run.read_buffer<int>("test.log");
        return {log.begin() + 1, log.begin() + 1 + log[0]};
    }
    void SetUp() override {
        GraphTest::SetUp();
        for (int i = 1; i <= 4; ++i)
            logger(std::string(1, char('a' + i - 1)) + ".comp", i);
    }
};

} // namespace

TEST_F(Loops, PassesTakeTheirStepsTogether) {
    GraphRunner run(graph_file(
        graph(node("a", "") + "," + node("b", loop("3")) + "," + node("c", loop("3")) + "," + node("d", "2"))));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_THAT(logged(run), ElementsAre(10, 20, 30, 21, 31, 22, 32, 40, 41));
    EXPECT_THAT(plan_text(run.graph.model(), run.graph.plan()), HasSubstr("in the loop 'together'"));
    run.frame(); // what a loop's first step clears is cleared once
    EXPECT_EQ(logged(run).size(), 9u);
}

TEST_F(Loops, StepsNeedNotBeginAtZero) {
    GraphRunner run(graph_file(graph(node("a", loop("5", "2")) + "," + node("b", loop("5", "2")))));
    run.frame();
    EXPECT_THAT(logged(run), ElementsAre(12, 22, 13, 23, 14, 24));
}

TEST_F(Loops, TwoLoopsRunOneAfterTheOther) {
    GraphRunner run(graph_file(graph(node("a", loop("2", "0", "one")) + "," + node("b", loop("2", "0", "one")) + "," +
                                     node("c", loop("2", "0", "two")) + "," + node("d", loop("2", "0", "two")))));
    run.frame();
    EXPECT_THAT(logged(run), ElementsAre(10, 20, 11, 21, 30, 40, 31, 41));
}

TEST_F(Loops, WithoutANameEachPassTakesItsStepsAlone) {
    GraphRunner run(graph_file(graph(node("a", "2") + "," + node("b", "2"))));
    run.frame();
    EXPECT_THAT(logged(run), ElementsAre(10, 11, 20, 21));
}

TEST_F(Loops, PassesBetweenThoseOfALoopAreAnError) {
    std::string error = error_of([&] {
        GraphRunner(graph_file(graph(node("a", loop("2")) + "," + node("b", "") + "," + node("c", loop("2"))))).frame();
    });
    EXPECT_THAT(error, HasSubstr("pass 'c' is of the loop 'together', as pass 'a' is, but others run between them"));
}

TEST_F(Loops, UnequalStepsAreAnError) {
    std::string error =
        error_of([&] { GraphRunner(graph_file(graph(node("a", loop("2")) + "," + node("b", loop("3"))))).frame(); });
    EXPECT_THAT(error, HasSubstr("pass 'b' takes the steps 0 … 2 of the loop 'together', and pass 'a' 0 … 1"));
}

/// One measurement a frame, the sum over its steps.
TEST_F(Loops, AFramesTimeIsThatOfAllSteps) {
    GraphRunner run(graph_file(graph(node("a", loop("6")) + "," + node("b", loop("6")))));
    run.frame(); // warms up
    run.graph.forget_timings();
    run.frame(5);
    run.graph.finish_timings();
    for (const char* id : {"a", "b"}) {
        EXPECT_EQ(run.graph.timing(id).samples, 5) << id;
        EXPECT_GT(run.graph.timing(id).median, 0) << id;
    }
    root.edit("assets/graphs/g.json", loop("6"), loop("3"));
    root.edit("assets/graphs/g.json", loop("6"), loop("3"));
    run.graph.poll_files();
    run.frame(); // fewer steps: the timers follow
    EXPECT_THAT(logged(run), ElementsAre(10, 20, 11, 21, 12, 22));
    EXPECT_GT(run.graph.timing("a").samples, 0);
}

TEST_F(Loops, PassesGrowUntilTheyHaveRoom) {
    GraphRunner run(graph_file(R"("passes":[{"id":"crate","type":"test_crate","params":{"items":5}}])"));
    CratePass::told.clear();
    run.frame();
    int tries = 0;
    while (run.graph.needs_larger_buffers() && tries < 10) {
        ++tries;
        run.frame();
    }
    EXPECT_EQ(tries, 3); // 1 → 2 → 4 → 5
    EXPECT_EQ(run.graph.buffer("crate.items")->bytes(), 5u * 4u);
    ASSERT_EQ(CratePass::told.size(), 4u);
    EXPECT_THAT(CratePass::told.front(), ElementsAre(5, 4));
    EXPECT_THAT(CratePass::told.back(), ElementsAre(5, 0));
    // Without waiting, as a window does, it has the room some frames later.
    run.graph.model().set("crate.items", "9", ParameterOrigin::panel);
    run.graph.touch();
    for (int i = 0; i < 12; ++i)
        run.frame();
    EXPECT_EQ(run.graph.buffer("crate.items")->bytes(), 9u * 4u);
    EXPECT_FALSE(run.graph.needs_larger_buffers());
}
