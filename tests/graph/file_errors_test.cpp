// What is wrong with a graph file is told at once, all of it, with what would be right.
#include "graph/graph_test.h"

#include "graph/plan.h"

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class GraphFileErrors : public PlanTest {
  protected:
    std::string errors(const std::string& members) const {
        return error_of([&] { read_graph_file(graph_file(members)); });
    }
};

TEST_F(GraphFileErrors, AllAreReportedTogether) {
    std::string text = errors(R"("colour": 3,
        "parameters": {"scale": {"range": [0, 1]}},
        "resources": {"blur": {}, "a.b": {"format": "rgba16g", "kind": "texture_4d"}},
        "passes": [{"type": "compoot"}, {"type": "compute"}, {"type": "compute", "id": "Big", "shader": "x.comp",
                    "repeat": {"over": "mip", "of": "a.b"}, "bind": {"a.b": 3}}])");
    EXPECT_THAT(text, HasSubstr("g.json: "));
    EXPECT_THAT(text, HasSubstr("there is no key 'colour'"));
    EXPECT_THAT(text, HasSubstr("parameters.scale: 'default' is missing"));
    EXPECT_THAT(text, HasSubstr("'blur' is no resource name"));
    EXPECT_THAT(text, HasSubstr("there is no format 'rgba16g' (did you mean 'rgba16"));
    EXPECT_THAT(text, HasSubstr("there is no kind 'texture_4d' (did you mean 'texture_"));
    EXPECT_THAT(text, HasSubstr("passes[0]: there is no pass type 'compoot' (did you mean 'compute'?)"));
    EXPECT_THAT(text, HasSubstr("passes[1]: 'shader' is missing"));
    EXPECT_THAT(text, HasSubstr("'Big' is no pass id"));
    EXPECT_THAT(text, HasSubstr("nothing repeats over 'mip' (did you mean 'mips'?)"));
    EXPECT_THAT(text, HasSubstr("passes[2].bind.a.b"));
}

/// Names of any length are read in one go, and told in short.
TEST_F(GraphFileErrors, NamesThatAreVeryLong) {
    const std::string name(26000, 'x');
    std::string text =
        errors("\"" + name + "\": 1, \"resources\": {\"" + name + "." + name + "\": {}, \"" + name + "\": {}}, " +
               "\"passes\": [{\"id\": \"" + name + "\", \"type\": \"compute\", \"shader\": \"x.comp\", " +
               "\"bind\": {\"a.b\": \"previous(" + name + ")\"}}, {\"type\": \"" + name + "\"}]");
    EXPECT_THAT(text, HasSubstr("there is no key 'xxxx"));
    EXPECT_THAT(text, HasSubstr("is no pass id"));
    EXPECT_THAT(text, HasSubstr("is no resource name"));
    EXPECT_THAT(errors("\"passes\": " + std::string(100000, '[')), HasSubstr("nested more than 64 levels"));
}

TEST_F(GraphFileErrors, FormsOfPrevious) {
    shader("x.comp", "");
    auto bound = [&](const std::string& source) {
        GraphFile file = read_graph_file(
            graph_file("\"passes\": [{\"id\":\"a\",\"type\":\"compute\",\"shader\":\"x.comp\",\"bind\":{\"a.b\":\"" +
                       source + "\"}}]"));
        const BindEntry& bind = file.nodes.at(0).bind.at("a.b");
        return std::string(bind.previous ? "previous " : "") + bind.resource;
    };
    EXPECT_EQ(bound("previous(c.d)"), "previous c.d");
    EXPECT_EQ(bound("previous( c.d )"), "previous c.d");
    EXPECT_EQ(bound("c.d"), "c.d");
    for (const char* other : {"previous()", "previous(c.d", "previous(c.d) x", "previous c.d", "xprevious(c.d)"})
        EXPECT_EQ(bound(other), other);
}

TEST_F(GraphFileErrors, BrokenJsonNamesItsLine) {
    root.write("assets/graphs/g.json", "{\n  \"version\": 1,\n  \"passes\": [,]\n}\n");
    EXPECT_THAT(error_of([&] { read_graph_file(root / "assets/graphs/g.json"); }),
                HasSubstr("g.json:3: not valid JSON"));
}

TEST_F(GraphFileErrors, NoVersionNoPassesTwiceTheSameId) {
    root.write("assets/graphs/g.json", "{}");
    EXPECT_THAT(error_of([&] { read_graph_file(root / "assets/graphs/g.json"); }),
                AllOf(HasSubstr("'version' must be 1"), HasSubstr("'passes' must be a list")));
    shader("x.comp", "");
    EXPECT_THAT(
        errors(
            R"("passes": [{"id":"x","type":"compute","shader":"x.comp"},{"id":"x","type":"compute","shader":"x.comp"},
                                     {"id":"graph","type":"compute","shader":"x.comp"}])"),
        AllOf(HasSubstr("two passes have the id 'x'"), HasSubstr("cannot have the id 'graph'")));
}

TEST_F(GraphFileErrors, TheTransportNamesParametersThatAreThere) {
    shader("x.comp", "uniform float d_max = 0.1; //! [0, 2] how far");
    auto model = [&](const std::string& name) {
        return GraphModel(
            read_graph_file(graph_file("\"transport\": {\"occlusion_distance\": \"" + name +
                                       R"("}, "passes": [{"id":"a","type":"compute","shader":"x.comp"}])")));
    };
    EXPECT_EQ(model("a.d_max").file().transport.occlusion_distance, "a.d_max");
    EXPECT_THAT(error_of([&] { model("a.dmax"); }),
                AllOf(HasSubstr("transport: "), HasSubstr("did you mean 'a.d_max'")));
}

TEST_F(GraphFileErrors, ParametersAreSharedWithAnEarlierPassOnly) {
    shader("x.comp", "uniform float width = 1.0; //! [0, 2] how wide");
    auto model = [&](const std::string& passes) {
        return GraphModel(read_graph_file(graph_file("\"passes\": [" + passes + "]")));
    };
    const std::string a = R"({"id":"a","type":"compute","shader":"x.comp"})",
                      b = R"({"id":"b","type":"compute","shader":"x.comp","params_of":"a"})";
    GraphModel shared = model(a + "," + b);
    shared.set("a.width", "1.5", ParameterOrigin::panel);
    EXPECT_EQ(std::get<float>(shared.parameter_of(*shared.find_node("b"), "width")->value), 1.5f);
    EXPECT_THAT(error_of([&] { shared.set("b.width", "1", ParameterOrigin::panel); }),
                HasSubstr("there is no parameter 'b.width'"));
    EXPECT_THAT(error_of([&] { model(b + "," + a); }), HasSubstr("pass 'b': params_of names no earlier pass: 'a'"));
}

TEST_F(GraphFileErrors, AGraphThatIsNotThereNamesTheNearest) {
    graph_file(R"("passes": [])");
    EXPECT_EQ(error_of([] { find_graph("gg"); }), "there is no graph 'gg' (did you mean 'g'?)");
}

TEST_F(GraphFileErrors, ParametersOfAllPassesAreCheckedTogether) {
    shader("x.comp", "uniform float width = 1.0; //! [0, 2] how wide\nuniform int kind = 0; //! {soft, hard} which");
    std::string text = error_of([&] {
        model(R"("passes": [{"id":"x","type":"compute","shader":"x.comp","params":{"widht": 1, "kind": "herd"}},
                            {"id":"y","type":"compute","shader":"x.comp","params":{"width": 3}}])");
    });
    EXPECT_THAT(text, HasSubstr("there is no parameter 'widht' (did you mean 'width'?)"));
    EXPECT_THAT(text, HasSubstr("'herd' is not a choice of parameter 'kind' (did you mean 'hard'?)"));
    EXPECT_THAT(text, HasSubstr("pass 'y': '3' is out of range for parameter 'width': it takes a number [0, 2]"));
}

/// The file, the parameters, declarations, sources, expressions, the order, and what a frame would run into: each phase
/// reports all that it finds, and the next one runs only when there is nothing, so that no error follows from another.
TEST_F(GraphFileErrors, EachPhaseReportsAllOfItsOwn) {
    shader("fill.comp", "uniform float gain = 1.0; //! [0, 2] gain\nlayout(FORMAT_a_a) writeonly uniform image2D a_a;");
    shader("reads.comp", "uniform sampler2D a_a;\nlayout(FORMAT_b_b) writeonly uniform image2D b_b;");
    shader("one.comp", "uniform sampler2D d_d;\nlayout(FORMAT_c_c) writeonly uniform image2D c_c;");
    shader("two.comp", "uniform sampler2D c_c;\nlayout(FORMAT_d_d) writeonly uniform image2D d_d;");
    std::string members =
        R"("resources": {"a.a": {}, "b.b": {"size": ["wdth", 1]}, "c.c": {}, "d.d": {"size": ["b.b.width", 1]},
                               "e.e": {"format": "rgba16g"}},
                 "passes": [{"id":"fill","type":"compute","shader":"fill.comp","params":{"gian": 1}},
                            {"id":"reads","type":"compute","shader":"reads.comp","bind":{"a.b":"a.a"}},
                            {"id":"again","type":"compute","shader":"fill.comp","dispatch":["widht", 1]},
                            {"id":"late","type":"compute","shader":"reads.comp","bind":{"a.a":"e.f"},"needs":"lihgts"},
                            {"id":"one","type":"compute","shader":"one.comp"},
                            {"id":"two","type":"compute","shader":"two.comp"}])";
    auto found = [&] { return error_of([&] { plan(members); }); };
    auto mend = [&](const std::string& wrong, const std::string& right) {
        members.replace(members.find(wrong), wrong.size(), right);
    };
    EXPECT_THAT(found(), AllOf(HasSubstr("there is no format 'rgba16g'"), Not(HasSubstr("errors\n"))));
    mend("rgba16g", "rgba16f");
    EXPECT_THAT(found(), AllOf(HasSubstr("pass 'fill': there is no parameter 'gian' (did you mean 'gain'?)"),
                               Not(HasSubstr("errors\n"))));
    mend("gian", "gain");
    EXPECT_THAT(found(),
                AllOf(HasSubstr(": 2 errors\n"), HasSubstr("pass 'reads' has no slot 'a.b' (did you mean 'a.a'?)"),
                      HasSubstr("reads 'e.f' (slot a.a), which nothing declares (did you mean 'e.e'?)")));
    mend("a.b", "a.a");
    mend("e.f", "a.a");
    EXPECT_THAT(found(),
                AllOf(HasSubstr(": 2 errors\n"), HasSubstr("pass 'late': 'needs': 'lihgts' in 'lihgts' is no name"),
                      HasSubstr("(did you mean 'lights'?)"),
                      HasSubstr("resource 'b.b' (declared by graph file): 'wdth' in 'wdth' is no name that is "
                                "known here (did you mean 'width'?)")));
    mend("lihgts", "1 - lights");
    mend("wdth", "width");
    EXPECT_THAT(found(),
                AllOf(HasSubstr("these passes wait for each other in a circle: one, two"), Not(HasSubstr("errors\n"))));
    mend(R"("id":"two")", R"("id":"two","enabled":false)");
    EXPECT_THAT(found(), AllOf(HasSubstr("pass 'again': 'dispatch': 'widht' in 'widht' is no name that is known here"),
                               Not(HasSubstr("errors\n"))));
    mend("widht", "width");
    EXPECT_THAT(found(), IsEmpty());
}

/// A pass that cannot be read may have made what others read: that they lack it is not known.
TEST_F(GraphFileErrors, WhatFollowsFromAnotherErrorIsNotTold) {
    shader("fill.comp", "layout(FORMAT_a_a) writeonly uniform image2D a_a;");
    shader("reads.comp", "uniform sampler2D a_a;\nuniform float gain = 1.0; //! [0, 2] gain\n"
                         "layout(FORMAT_b_b) writeonly uniform image2D b_b;");
    std::string text = error_of([&] {
        model(R"("parameters": {"scale": {"range": [1, 2]}},
                 "resources": {"a.a": {}, "b.b": {"size": ["graph.scale * width", 1]}},
                 "passes": [{"id":"fill","type":"compoot","shader":"fill.comp"},
                            {"id":"reads","type":"compute","shader":"reads.comp","params":{"gain":"=graph.scale"},
                             "dispatch": ["b.b.width", 1]}])");
    });
    EXPECT_THAT(text, AllOf(HasSubstr("'default' is missing"), HasSubstr("no pass type 'compoot'"),
                            HasSubstr("only passes of type compute take a 'shader'")));
    EXPECT_THAT(text, HasSubstr(": 3 errors\n"));
}

TEST_F(GraphFileErrors, SlotsWithoutSourceAreToldTogetherWithWhatThereIs) {
    shader("x.comp", "uniform sampler2D blur_sorce;\nlayout(FORMAT_made_here) writeonly uniform image2D made_here;\n"
                     "layout(std430) buffer blur_source { float values[]; };");
    std::string text = error_of([&] {
        plan(R"("resources": {"blur.source": {}, "made.here": {}},
                "passes": [{"id":"x","type":"compute","shader":"x.comp","bind":{"made.there":"made.here"}}])");
    });
    EXPECT_THAT(
        text,
        HasSubstr("pass 'x' (x.comp:2) reads 'blur.sorce', which nothing declares (did you mean 'blur.source'?)"));
    EXPECT_THAT(text, HasSubstr("uses 'blur.source' as a buffer, but it is a texture_2d"));
    EXPECT_THAT(text, HasSubstr("pass 'x' has no slot 'made.there' (did you mean 'made.here'?)"));
}

TEST_F(GraphFileErrors, SizesThatCannotBe) {
    shader("x.comp",
           "layout(FORMAT_a_a) writeonly uniform image2D a_a; layout(FORMAT_b_b) writeonly uniform image2D b_b;");
    shader("x.comp",
           "layout(FORMAT_a_a) writeonly uniform image2D a_a;\nlayout(FORMAT_b_b) writeonly uniform image2D b_b;\n"
           "layout(FORMAT_c_c) writeonly uniform image2D c_c;\nlayout(FORMAT_d_d) writeonly uniform image2D d_d;");
    std::string text = error_of([&] {
        plan(R"("resources": {"a.a": {"size": ["b.b.width", 1]}, "b.b": {"size": ["a.a.width", 1]},
                              "c.c": {"size": ["wdth / 2", 1]}, "d.d": {"size": ["width - 700", 4]}},
                "passes": [{"id":"x","type":"compute","shader":"x.comp"}])");
    });
    EXPECT_THAT(text, HasSubstr("depends on itself"));
    EXPECT_THAT(text, HasSubstr("'wdth' in 'wdth / 2' is no name that is known here"));
    EXPECT_THAT(text, HasSubstr("'width - 700' gives -60; it must be at least 1"));
}

/// An expression that only a frame evaluates must not wait for that frame to be found wrong.
TEST_F(GraphFileErrors, DispatchAndBindExpressionsAreCheckedWithThePlan) {
    shader("x.comp", "layout(FORMAT_a_a) writeonly uniform image2D a_a;");
    std::string start =
        R"("resources": {"a.a": {"mips": 3, "size": [8, 8]}}, "passes": [{"id":"x","type":"compute","shader":"x.comp",)";
    auto problem = [&](const std::string& rest) { return error_of([&] { plan(start + rest + "}]"); }); };
    EXPECT_THAT(problem(R"("dispatch": ["widht", 1])"), HasSubstr("'widht' in 'widht' is no name that is known here"));
    EXPECT_THAT(problem(R"("dispatch": ["width -", 1])"), HasSubstr("is no expression"));
    EXPECT_THAT(problem(R"("dispatch": "a.b")"), HasSubstr("a.b"));
    EXPECT_THAT(problem(R"("bind": {"a.a": {"resource": "a.a", "mip": "iteration - 1"}})"),
                HasSubstr("must be at least 0"));
    EXPECT_THAT(problem(R"("bind": {"a.a": {"resource": "a.a", "mip": "iterration"}})"), HasSubstr("iterration"));
    EXPECT_THAT(problem(R"("dispatch": ["width", "height", "iteration + 1"], "repeat": {"over": "mips", "of": "a.a"},
                           "bind": {"a.a": {"resource": "a.a", "mip": "iteration"}})"),
                IsEmpty());
}

TEST_F(GraphFileErrors, WhatAShaderCannotDoWithItsResource) {
    shader("reads.comp", "uniform sampler3D a_a;\nlayout(FORMAT_b_b) writeonly uniform image2D b_b;");
    shader("fill.comp", "layout(FORMAT_a_a) writeonly uniform image2D a_a;");
    std::string text = error_of([&] {
        plan(R"("resources": {"a.a": {}, "b.b": {"format": "srgb8_alpha8"}},
                "passes": [{"id":"fill","type":"compute","shader":"fill.comp"},{"id":"reads","type":"compute","shader":"reads.comp"}])");
    });
    EXPECT_THAT(text, HasSubstr("pass 'reads' (reads.comp:2) uses 'a.a' as a sampler3D, but it is a texture_2d"));
    EXPECT_THAT(text, HasSubstr("srgb8_alpha8"));
    shader("previous.comp", "layout(FORMAT_a_a) uniform image2D a_a;");
    EXPECT_THAT(
        error_of([&] {
            plan(
                R"-("resources": {"a.a": {}}, "passes": [{"id":"x","type":"compute","shader":"fill.comp","bind":{"a.a":"previous(a.a)"}}])-");
        }),
        HasSubstr("last frame's copy"));
}
