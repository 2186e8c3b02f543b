// Order, skipped passes, sizes and names of a plan. No OpenGL.
#include "graph/graph_test.h"

#include "graph/plan.h"

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

/// A pass in C++ with what the tests need of one: a resource of its own, with a neutral value, unless there is no
/// light.
class LampPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.parameters.add("detail", detail_, {1, 64}, "texels", "width of its map");
    }
    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "there is no light";
    }
    void declare(Declaration& d) override {
        d.creates("lamp.map", ResourceKind::texture_2d, "r16f", {detail_, 4}).neutral = glm::vec4(1);
        d.writes("lamp.map", Usage::colour);
    }
    void execute(PassContext&) override {}

  private:
    int detail_ = 8;
};

BOUNCE_REGISTER_PASS("test_lamp", LampPass, "for tests")

std::string image(const std::string& name, const std::string& access = "writeonly") {
    return "layout(FORMAT_" + name + ") " + access + " uniform image2D " + name + ";\n";
}

std::string node(const std::string& id, const std::string& more = "") {
    return "{\"id\":\"" + id + "\",\"type\":\"compute\",\"shader\":\"" + id + ".comp\"" + more + "}";
}

SceneFacts one_light() {
    SceneFacts facts;
    facts.spot_lights = 1;
    return facts;
}

std::string reason(const Plan& plan, const std::string& id) {
    for (const PlanSkip& skipped : plan.skipped)
        if (skipped.id == id) return skipped.reason;
    return "";
}

} // namespace

TEST_F(PlanTest, AReaderListedBeforeItsWriterIsMovedBehindIt) {
    shader("reader.comp", "uniform sampler2D a_a;\n" + image("b_b"));
    shader("writer.comp", image("a_a"));
    shader("last.comp", "uniform sampler2D b_b;\n" + image("c_c"));
    std::string resources = R"("resources":{"a.a":{},"b.b":{},"c.c":{}},)";
    EXPECT_THAT(
        order(plan(resources + "\"passes\":[" + node("last") + "," + node("reader") + "," + node("writer") + "]")),
        ElementsAre("writer", "reader", "last"));
}

TEST_F(PlanTest, AReaderBetweenTwoWritersSeesTheFirst) {
    shader("first.comp", image("a_a"));
    shader("reader.comp", "uniform sampler2D a_a;\n" + image("b_b"));
    shader("second.comp", image("a_a", ""));
    Plan p = plan(R"("resources":{"a.a":{},"b.b":{}},"passes":[)" + node("first") + "," + node("reader") + "," +
                  node("second") + "]");
    EXPECT_THAT(order(p), ElementsAre("first", "reader", "second"));
    // The second stores to what the first stored to and what the reader reads: neither may still be under way.
    EXPECT_EQ(p.passes[1].barriers, GLbitfield(GL_TEXTURE_FETCH_BARRIER_BIT));
    EXPECT_EQ(p.passes[2].barriers, GLbitfield(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT));
    EXPECT_EQ(p.passes[0].clears.size(), 1u);
    EXPECT_TRUE(p.passes[2].clears.empty());
}

/// Shader stores after another shader's reads of the same texels wait for them only if a barrier says so.
TEST_F(PlanTest, AStoreToWhatWasReadBeforeHasABarrier) {
    shader("swap.comp", "uniform sampler2D lamp_map;\n" + image("b_b"));
    shader("other.comp", image("c_c"));
    shader("back.comp", image("lamp_map"));
    Plan p = plan(R"("resources":{"b.b":{},"c.c":{}},"passes":[{"type":"test_lamp"},)" + node("swap") + "," +
                      node("other") + "," + node("back") + "]",
                  one_light());
    ASSERT_THAT(order(p), ElementsAre("test_lamp", "swap", "other", "back"));
    EXPECT_EQ(p.passes[1].barriers, 0u) << "what was drawn needs none";
    EXPECT_EQ(p.passes[2].barriers, 0u) << "touches nothing that was touched before";
    EXPECT_EQ(p.passes[3].barriers, GLbitfield(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT));
}

TEST_F(PlanTest, ACycleNamesItsPasses) {
    shader("a.comp", "uniform sampler2D b_b;\n" + image("a_a"));
    shader("b.comp", "uniform sampler2D a_a;\n" + image("b_b"));
    shader("c.comp", image("c_c"));
    std::string resources = R"("resources":{"a.a":{},"b.b":{},"c.c":{}},)";
    std::string text =
        error_of([&] { plan(resources + "\"passes\":[" + node("a") + "," + node("b") + "," + node("c") + "]"); });
    EXPECT_THAT(text, HasSubstr("in a circle: a, b "));
    EXPECT_THAT(text, HasSubstr("previous(name)"));
    Plan p = plan(resources + "\"passes\":[" + node("a", R"-(,"bind":{"b.b":"previous(b.b)"})-") + "," + node("b") +
                  "," + node("c") + "]");
    EXPECT_THAT(order(p), ElementsAre("a", "b", "c"));
    EXPECT_TRUE(p.find_resource("b.b")->needs_previous);
    EXPECT_EQ(p.find_resource("b.b")->total_bytes(), 2 * p.find_resource("b.b")->bytes);
}

TEST_F(PlanTest, DeclinesSpreadToWhatOnlyTheyFeedAndWhatOnlyFeedsThem) {
    shader("feeder.comp", image("feed_map"));                                   // read by nobody else
    shader("after.comp", "uniform sampler2D lamp_map;\n" + image("after_map")); // reads nothing else
    shader("needy.comp", "uniform sampler2D feed_map;\n" + image("needy_map"));
    shader("show.comp", "uniform sampler2D lamp_map;\nuniform sampler2D after_map;\n" + image("out_display"));
    std::string members =
        R"("resources":{"feed.map":{},"after.map":{},"needy.map":{},"out.display":{}},"passes":[{"type":"test_lamp"},)" +
        node("feeder") + "," + node("after") + "," + node("needy", R"(,"needs":"emissive_materials")") + "," +
        node("show") + "]";
    Plan dark = plan(members);
    EXPECT_THAT(order(dark), ElementsAre("show"));
    EXPECT_EQ(reason(dark, "test_lamp"), "there is no light");
    EXPECT_THAT(reason(dark, "after"), HasSubstr("comes from skipped passes"));
    EXPECT_EQ(reason(dark, "needy"), "requires emissive materials");
    EXPECT_THAT(reason(dark, "feeder"), HasSubstr("only skipped passes read"));
    EXPECT_EQ(dark.find_resource("lamp.map"), nullptr) << "what nobody makes takes no memory";
    EXPECT_EQ(dark.passes[0].find("lamp.map")->resource, -1);
    EXPECT_EQ(dark.passes[0].find("lamp.map")->neutral, glm::vec4(1));

    Plan lit = plan(members, one_light());
    EXPECT_THAT(order(lit), ElementsAre("test_lamp", "after", "show"));
    EXPECT_NE(lit.find_resource("lamp.map"), nullptr);
}

TEST_F(PlanTest, APassThatIsSwitchedOffDeclines) {
    Plan p = plan(R"("passes":[{"type":"test_lamp","enabled":false}])", one_light());
    EXPECT_EQ(reason(p, "test_lamp"), "switched off");
}

TEST_F(PlanTest, SizesByExpressionAndRelativeToOthers) {
    shader("x.comp", image("a_half") + image("a_third") + image("a_chain") + image("a_scaled") + image("a_same") +
                         "layout(std430) buffer list_nodes { uint nodes[]; };");
    std::string members = R"-("parameters":{"scale":{"default":0.25,"range":[0.1,1]},"per_pixel":{"default":3}},
        "resources":{"a.half":{"size":["width / 2","height / 2"]},
                     "a.third":{"size":{"of":"a.half","scale":"1/3"}},
                     "a.chain":{"size":[100,7],"mips":"full","format":"r32f"},
                     "a.scaled":{"size":["ceil(width * graph.scale)","max(4, scale * 2)",1]},
                     "a.same":{"size":"a.third","mips":"a.chain.mips - 3"},
                     "list.nodes":{"kind":"buffer","count":"width * height * per_pixel","stride":12}},
        "passes":[)-" + node("x") +
                          "]";
    Plan p = plan(members, {}, {641, 360});
    auto size = [&](const char* name) { return p.find_resource(name)->texture.size; };
    EXPECT_EQ(size("a.half"), glm::ivec3(320, 180, 1));
    EXPECT_EQ(size("a.third"), glm::ivec3(107, 60, 1));
    EXPECT_EQ(p.find_resource("a.chain")->texture.mips, 7);
    EXPECT_EQ(p.find_resource("a.chain")->bytes, 4u * (100 * 7 + 50 * 3 + 25 + 12 + 6 + 3 + 1));
    EXPECT_EQ(size("a.scaled"), glm::ivec3(161, 4, 1));
    EXPECT_EQ(size("a.same"), glm::ivec3(107, 60, 1));
    EXPECT_EQ(p.find_resource("a.same")->texture.mips, 4);
    EXPECT_EQ(p.find_resource("list.nodes")->count, 641u * 360 * 3);
    EXPECT_EQ(p.find_resource("list.nodes")->bytes, 641u * 360 * 3 * 12);
}

TEST_F(PlanTest, TheFileOverridesOnlyWhatItNamesOfAPasssResource) {
    Plan p =
        plan(R"("resources":{"lamp.map":{"format":"r32f"}},"passes":[{"type":"test_lamp","params":{"detail":32}}])",
             one_light());
    const PlanResource& map = *p.find_resource("lamp.map");
    EXPECT_EQ(map.declaration.format, "r32f");
    EXPECT_EQ(map.texture.format, GLenum(GL_R32F));
    EXPECT_EQ(map.texture.size, glm::ivec3(32, 4, 1));
    EXPECT_EQ(map.declaration.neutral, glm::vec4(1));
    EXPECT_EQ(map.bytes, 32u * 4 * 4);
    Plan q = plan(R"("resources":{"lamp.map":{"size":[5, 6]}},"passes":[{"type":"test_lamp"}])", one_light());
    EXPECT_EQ(q.find_resource("lamp.map")->texture.size, glm::ivec3(5, 6, 1));
    EXPECT_EQ(q.find_resource("lamp.map")->declaration.format, "r16f");
}

TEST_F(PlanTest, TwoOfAKindNeedOneRenamed) {
    std::string text =
        error_of([&] { plan(R"("passes":[{"type":"test_lamp"},{"id":"two","type":"test_lamp"}])", one_light()); });
    EXPECT_THAT(text, HasSubstr("both make 'lamp.map'"));
    Plan p = plan(
        R"("passes":[{"type":"test_lamp"},{"id":"two","type":"test_lamp","bind":{"lamp.map":"lamp.second"},"params":{"detail":16}}])",
        one_light());
    EXPECT_EQ(p.find_resource("lamp.map")->texture.size.x, 8);
    EXPECT_EQ(p.find_resource("lamp.second")->texture.size.x, 16);
}

TEST_F(PlanTest, AValueMayBeAnExpressionOfTheGraphsParameters) {
    GraphModel m = model(
        R"("parameters":{"texels":{"default":20}},"passes":[{"type":"test_lamp","params":{"detail":"=texels / 2"}}])");
    EXPECT_EQ(m.plan(one_light(), {8, 8}).find_resource("lamp.map")->texture.size.x, 10);
    m.set("graph.texels", "40", ParameterOrigin::command_line);
    EXPECT_EQ(m.plan(one_light(), {8, 8}).find_resource("lamp.map")->texture.size.x, 20);
    m.set("test_lamp.detail", "3", ParameterOrigin::command_line);
    m.set("graph.texels", "60", ParameterOrigin::command_line);
    EXPECT_EQ(m.plan(one_light(), {8, 8}).find_resource("lamp.map")->texture.size.x, 3) << "a person's value stands";
    EXPECT_THAT(error_of([&] { m.set("test_lmap.detail", "3", ParameterOrigin::panel); }),
                HasSubstr("did you mean 'test_lamp.detail'?"));
}

/// An enumeration is followed by name. What is compiled in is read again, so that other slots come and go.
TEST_F(PlanTest, AValueMayFollowAnEnumerationOfTheGraph) {
    shader("pick.comp", "uniform int way = 0; //! static {left, right} which\n"
                        "#if way == way_left\nuniform sampler2D a_left;\n#endif\n"
                        "#if way == way_right\nuniform sampler2D a_right;\n#endif\n" +
                            image("a_out"));
    shader("left.comp", image("a_left"));
    shader("right.comp", image("a_right"));
    GraphModel m =
        model(R"("parameters":{"side":{"default":"right","choices":["left","right"]}},)"
              R"("resources":{"a.left":{"size":[8,8]},"a.right":{"size":[8,8]},"a.out":{"size":[8,8]}},"passes":[)" +
              node("left") + "," + node("right") + "," + node("pick", R"(,"params":{"way":"=graph.side"})") + "]");
    auto reads = [&](const std::string& slot) {
        for (const PlanPass& pass : m.plan(one_light(), {8, 8}).passes)
            for (const PlanSlot& used : pass.slots)
                if (pass.id == "pick" && used.use.slot == slot) return true;
        return false;
    };
    EXPECT_TRUE(reads("a.right"));
    EXPECT_FALSE(reads("a.left"));
    m.set("graph.side", "left", ParameterOrigin::command_line);
    EXPECT_FALSE(reads("a.right"));
    EXPECT_TRUE(reads("a.left"));
}

TEST_F(PlanTest, TextAndGraphvizTellOrderSizesBarriersAndDeclines) {
    shader("mips.comp", "uniform sampler2D a_source;\n" + image("a_target"));
    shader("fill.comp", image("a_chain"));
    std::string members =
        R"("about":"What it is for.","resources":{"a.chain":{"size":[8,8],"mips":"full"}},"passes":[{"type":"test_lamp"},)" +
        node("fill") + "," +
        node(
            "mips",
            R"(,"bind":{"a.source":{"resource":"a.chain","mip":"iteration - 1"},"a.target":{"resource":"a.chain","mip":"iteration"}},)"
            R"("repeat":{"over":"mips","of":"a.chain","from":1})") +
        "]";
    GraphModel m = model(members);
    Plan p = m.plan({}, {64, 32});
    std::string text = plan_text(m, p);
    EXPECT_THAT(text, HasSubstr("What it is for."));
    EXPECT_THAT(text, HasSubstr("mips (compute mips.comp), steps 1 … 3"));
    EXPECT_THAT(text, HasSubstr("between steps texture_fetch|shader_image_access"));
    EXPECT_THAT(text, HasSubstr("a.chain mip iteration - 1 as a.source"));
    EXPECT_THAT(text, HasSubstr("test_lamp: there is no light"));
    EXPECT_THAT(text, HasSubstr("texture_2d rgba16f 8×8, 4 mips"));
    EXPECT_THAT(text, HasSubstr(std::to_string(8 * (64 + 16 + 4 + 1)) + " bytes"));
    std::string dot = plan_graphviz(m, p);
    EXPECT_THAT(dot, HasSubstr("digraph \"g\" {"));
    EXPECT_THAT(dot, HasSubstr("\"pass fill\" -> \"a.chain\";"));
    EXPECT_THAT(dot, HasSubstr("\"a.chain\" -> \"pass mips\""));
    EXPECT_THAT(dot, HasSubstr("style=dashed"));
}
