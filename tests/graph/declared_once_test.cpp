// What is declared with a slot or a pass, and is repeated by no graph: sources, neutral values, steps of loops, names
// in expressions. No OpenGL.
#include "graph/graph_test.h"

#include "graph/plan.h"

using namespace bounce;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

/// Takes its steps in a loop of its own, and binds a slot.
class BatchPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("main", {"batch.comp"});
        description.bind("batch.input", "first.image");
    }
    void declare(Declaration& d) override {
        d.uses("main");
        d.creates("batch.image", ResourceKind::texture_2d, "r16f", {4, 4});
        d.repeat(0, 3, "batch");
    }
    void execute(PassContext&) override {}
};

BOUNCE_REGISTER_PASS("test_batch", BatchPass, "for tests")

std::string image(const std::string& name, const std::string& note = "") {
    return "layout(FORMAT_" + name + ") writeonly uniform image2D " + name + ";" + note + "\n";
}

std::string node(const std::string& id, const std::string& more = "") {
    return "{\"id\":\"" + id + "\",\"type\":\"compute\",\"shader\":\"" + id + ".comp\"" + more + "}";
}

std::string reason(const Plan& plan, const std::string& id) {
    for (const PlanSkip& skipped : plan.skipped)
        if (skipped.id == id) return skipped.reason;
    return "";
}

} // namespace

class DeclaredOnce : public PlanTest {};

TEST_F(DeclaredOnce, ASlotsSourceIsThatOfItsLineUnlessTheFileBindsAnother) {
    shader("first.comp", image("first_image"));
    shader("second.comp", image("second_image"));
    shader("reads.comp", "uniform sampler2D a_source; //! from first.image\n"
                         "uniform sampler2D a_follows; //! from a.source\n" +
                             image("out_display"));
    std::string start = R"("resources":{"first.image":{},"second.image":{},"out.display":{}},"passes":[)" +
                        node("first") + "," + node("second") + ",";
    auto sources = [&](const std::string& more) {
        Plan p = plan(start + node("reads", more) + "]");
        return std::vector{p.passes.back().find("a.source")->bind.resource,
                           p.passes.back().find("a.follows")->bind.resource};
    };
    EXPECT_THAT(sources(R"(,"bind":{"a.follows":"second.image"})"), ElementsAre("first.image", "second.image"));
    EXPECT_THAT(sources(R"(,"bind":{"a.source":"second.image"})"), ElementsAre("second.image", "second.image"))
        << "what names a slot of the pass follows what the file binds that to";
    EXPECT_THAT(sources(""), ElementsAre("first.image", "first.image"));
}

TEST_F(DeclaredOnce, AMipOfASourceIsTakenWithTheStep) {
    shader("fill.comp", image("a_chain"));
    shader("mips.comp", "uniform sampler2D a_finer; //! from a.chain mip iteration - 1\n" +
                            image("a_coarser", " //! from a.chain mip iteration"));
    Plan p = plan(R"("resources":{"a.chain":{"size":[8,8],"mips":"full"}},"passes":[)" + node("fill") + "," +
                  node("mips", R"(,"repeat":{"over":"mips","of":"a.chain","from":1})") + "]");
    EXPECT_EQ(p.passes[1].find("a.finer")->bind.mip, "iteration - 1");
    EXPECT_EQ(p.passes[1].find("a.coarser")->bind.resource, "a.chain");
    EXPECT_EQ(p.resources.size(), 1u);
}

TEST_F(DeclaredOnce, NeutralValuesComeFromTheSlotThenTheFileThenTheWriter) {
    shader("writes.comp", image("a_open", " //! neutral 1") + image("a_plain"));
    shader("reads.comp", "uniform sampler2D a_open;\nuniform sampler2D a_plain; //! neutral 0.5\n"
                         "uniform sampler2D a_gone; //! optional, neutral 1\n" +
                             image("out_display"));
    std::string passes = R"("passes":[)" + node("writes", R"(,"enabled":false)") + "," + node("reads") + "]";
    auto neutrals = [&](const std::string& of_open) {
        Plan p = plan(R"("resources":{"a.open":{)" + of_open + R"(},"a.plain":{},"out.display":{}},)" + passes);
        return std::vector{p.passes[0].find("a.open")->neutral.x, p.passes[0].find("a.plain")->neutral.x,
                           p.passes[0].find("a.gone")->neutral.x};
    };
    EXPECT_THAT(neutrals(""), ElementsAre(1, 0.5f, 1))
        << "that of the writer, that of the reader, and where nothing is";
    EXPECT_THAT(neutrals(R"("neutral":[0,0,0,0])"), ElementsAre(0, 0.5f, 1)) << "the file's goes before the writer's";
}

TEST_F(DeclaredOnce, AnOptionalSlotMayBeRequiredByAParameter) {
    shader("writes.comp", image("a_image"));
    shader("reads.comp", "uniform int kind = 0; //! {soft, hard} which\n"
                         "uniform sampler2D a_image; //! optional unless kind == hard\n" +
                             image("out_display"));
    std::string start = R"("resources":{"a.image":{},"out.display":{}},"passes":[)";
    auto problem = [&](const std::string& more, const std::string& passes) {
        return error_of([&] { plan(start + node("reads", more) + passes + "]"); });
    };
    EXPECT_EQ(problem("", ""), "");
    EXPECT_THAT(problem(R"(,"params":{"kind":"hard"})", ""),
                HasSubstr("pass 'reads' (reads.comp:3) reads 'a.image' with kind == hard, which nothing writes"));
    EXPECT_EQ(problem(R"(,"params":{"kind":"hard"})", "," + node("writes")), "");
    EXPECT_EQ(problem(R"(,"params":{"kind":"hard"})", "," + node("writes", R"(,"enabled":false)")), "");
}

TEST_F(DeclaredOnce, APassJoinsALoopByItsName) {
    shader("first.comp", image("first_image"));
    shader("batch.comp", "uniform sampler2D batch_input;\n" + image("batch_image"));
    shader("joins.comp", "uniform sampler2D batch_image;\n" + image("out_display"));
    std::string start =
        R"("resources":{"first.image":{},"out.display":{}},"passes":[)" + node("first") + R"(,{"type":"test_batch"},)";
    Plan p = plan(start + node("joins", R"(,"repeat":{"loop":"batch"})") + "]");
    EXPECT_EQ(p.passes[1].find("batch.input")->bind.resource, "first.image") << "bound by the pass";
    EXPECT_EQ(p.passes[2].loop, "batch");
    EXPECT_EQ(p.passes[2].repeat_to, 3);
    EXPECT_THAT(error_of([&] { plan(start + node("joins", R"(,"repeat":{"loop":"bach"})") + "]"); }),
                HasSubstr("no pass says what the steps of the loop 'bach' are (did you mean 'batch'?)"));
}

/// Sizes, dispatches, needs, repeats and bound mips know the same names.
TEST_F(DeclaredOnce, ExpressionsHaveOneScope) {
    shader("a.comp", "uniform int kind = 1; //! {soft, hard} which\n" + image("a_image") + image("b_image"));
    SceneFacts facts;
    facts.spot_lights = 2;
    facts.triangles = 12;
    facts.glossy_materials = 1;
    const std::string all =
        "(width > 0 && height > 0 && lights == 2 && shadow_views == 2 && triangles == 12 && "
        "glossy_materials && graph.scale == 3 && scale == 3 && a.kind == hard && b.image.width == 5)";
    Plan p =
        plan(R"("parameters":{"scale":{"default":3}},"resources":{"a.image":{"size":[")" + all +
                 R"( * 7",4],"mips":2},"b.image":{"size":[5,1]}},"passes":[)" +
                 node("a", R"(,"needs":")" + all + R"(","repeat":")" + all + R"( * 2","dispatch":[")" + all +
                               R"("],"bind":{"a.image":{"resource":"a.image","mip":")" + all + R"( * iteration"}})") +
                 "]",
             facts);
    ASSERT_EQ(p.passes.size(), 1u);
    EXPECT_EQ(p.find_resource("a.image")->texture.size.x, 7);
    EXPECT_EQ(p.passes[0].repeat_to, 2);
    auto refused = [&](const std::string& more) {
        return error_of(
            [&] { plan(R"("resources":{"a.image":{},"b.image":{}},"passes":[)" + node("a", more) + "]", facts); });
    };
    EXPECT_THAT(refused(R"(,"needs":"glosy_materials")"),
                HasSubstr("'needs': 'glosy_materials' in 'glosy_materials' is no "
                          "name that is known here (did you mean 'glossy_materials'?)"));
    EXPECT_THAT(refused(R"(,"needs":"a.kind == herd")"), HasSubstr("(did you mean 'hard'?)"));
    EXPECT_THAT(refused(R"(,"repeat":"lihgts")"), HasSubstr("(did you mean 'lights'?)"));
    EXPECT_THAT(refused(R"(,"dispatch":["a.image.widht"])"), HasSubstr("(did you mean 'a.image.width'?)"));
    EXPECT_THAT(refused(R"(,"bind":{"a.image":{"resource":"a.image","mip":"a.kin"}})"),
                HasSubstr("(did you mean 'a.kind'?)"));
    EXPECT_THAT(error_of([&] { model(R"("parameters":{"lights":{"default":3}},"passes":[)" + node("a") + "]"); }),
                HasSubstr("invalid parameter name 'lights'"));
}

TEST_F(DeclaredOnce, WhatANeedAsksForIsTheReason) {
    shader("a.comp", "uniform int kind = 0; //! {soft, hard} which\n" + image("out_display"));
    auto reason_of = [&](const std::string& needs) {
        return reason(
            plan(R"("resources":{"out.display":{}},"passes":[)" + node("a", R"(,"needs":")" + needs + "\"") + "]"),
            "a");
    };
    EXPECT_EQ(reason_of("lights && glossy_materials"), "requires lights and glossy materials");
    EXPECT_EQ(reason_of("point_lights || a.kind == hard"), "requires point lights or a.kind == hard");
}

/// A base declares outputs that not every graph makes.
TEST_F(DeclaredOnce, WhatNobodyWritesTakesNoMemory) {
    shader("reads.comp", "uniform sampler2D out_part; //! optional\n" + image("out_display"));
    Plan p = plan(R"("resources":{"out.part":{},"out.display":{}},"passes":[)" + node("reads") + "]");
    EXPECT_EQ(p.find_resource("out.part"), nullptr);
    EXPECT_EQ(p.passes[0].find("out.part")->resource, -1);
}

/// A person who switches passes off pays for nothing that only fed them, also where what is left feeds itself.
TEST_F(DeclaredOnce, WhatOnlySwitchedOffPassesReadIsDropped) {
    shader("first.comp", image("a_image"));
    shader("again.comp", "uniform sampler2D b_image;\nlayout(FORMAT_a_image) uniform image2D a_image;\n");
    shader("other.comp", "uniform sampler2D a_image;\nlayout(FORMAT_b_image) uniform image2D b_image;\n");
    shader("shows.comp", "uniform sampler2D b_image;\n" + image("out_part"));
    shader("rest.comp", image("out_display"));
    GraphModel m = model(R"("resources":{"a.image":{},"b.image":{},"out.part":{},"out.display":{}},"passes":[)" +
                         node("first") + "," + node("again", R"-(,"bind":{"b.image":"previous(b.image)"})-") + "," +
                         node("other") + "," + node("shows") + "," + node("rest") + "]");
    EXPECT_THAT(order(m.plan({}, {8, 8})), ElementsAre("first", "again", "other", "shows", "rest"));
    m.switch_pass("shows", false);
    Plan p = m.plan({}, {8, 8});
    EXPECT_THAT(order(p), ElementsAre("rest"));
    EXPECT_EQ(reason(p, "shows"), "switched off");
    for (const char* id : {"first", "again", "other"})
        EXPECT_EQ(reason(p, id), "only skipped passes read what it makes") << id;
}
