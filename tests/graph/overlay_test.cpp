// Graph files that extend others: what the chain comes to, what is wrong with one, and the way back from two graphs to
// the overlay between them.
#include "graph/graph_test.h"

#include "graph/graph_overlay.h"

#include <fmt/format.h>
#include <random>

using namespace bounce;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

class Overlays : public PlanTest {
  protected:
    Overlays() {
        shader("a.comp", "uniform float gain = 1.0; //! [0, 9] gain\nuniform float bias = 0.0; //! [0, 9] bias\n"
                         "layout(FORMAT_a_image) writeonly uniform image2D a_image;");
        shader("b.comp", "uniform sampler2D a_image;\nlayout(FORMAT_b_image) writeonly uniform image2D b_image;");
        write("base", R"("about":"the base","transport":{"bounces":1,"parts":["out.x"]},
            "parameters":{"scale":{"default":0.5,"range":[0,1]}},
            "resources":{"a.image":{"size":[8,4],"clear":false},"b.image":{"size":[8,4]},"c.image":{"size":[8,4]}},
            "passes":[{"id":"a","type":"compute","shader":"a.comp","params":{"gain":2,"bias":3}},
                      {"id":"b","type":"compute","shader":"b.comp","bind":{"b.image":"c.image"}}])");
    }
    std::filesystem::path write(const std::string& name, const std::string& members) const {
        root.write("assets/graphs/" + name + ".json", "{\"version\": 1, " + members + "}");
        return root / ("assets/graphs/" + name + ".json");
    }
    /// A graph that extends the base.
    GraphFile read(const std::string& members) const {
        return read_graph_file(write("g", R"("extends":"base")" + (members.empty() ? "" : "," + members)));
    }
    std::string problem(const std::string& members) const {
        return error_of([&] { read(members); });
    }
    static std::vector<std::string> ids(const GraphFile& file) {
        std::vector<std::string> ids;
        for (const NodeEntry& node : file.nodes)
            ids.push_back(node.id);
        return ids;
    }
    static const ResourceDeclaration& resource(const GraphFile& file, const std::string& name) {
        for (const ResourceDeclaration& known : file.resources)
            if (known.name == name) return known;
        throw std::runtime_error(name);
    }
};

} // namespace

TEST_F(Overlays, WhatIsNotSaidIsTheBases) {
    GraphFile file = read("");
    EXPECT_EQ(file.name, "g");
    EXPECT_EQ(file.about, "the base");
    EXPECT_EQ(file.transport.bounces, 1);
    EXPECT_THAT(ids(file), ElementsAre("a", "b"));
    EXPECT_EQ(file.nodes[0].params_json.at("gain"), "2");
    EXPECT_THAT(file.files, ElementsAre(root / "assets/graphs/g.json", root / "assets/graphs/base.json"));
}

TEST_F(Overlays, MembersTakeThePlaceOfTheBasesAndNullTakesAway) {
    GraphFile file = read(R"("about":"mine","transport":{"bounces":2},
        "parameters":{"scale":{"default":0.25},"more":{"default":7}},
        "resources":{"a.image":{"format":"r16"},"b.image":null,"d.image":{"format":"r32f"}},
        "passes":[{"id":"a","params":{"gain":5,"bias":null},"needs":"lights","enabled":false},{"id":"b","bind":{"b.image":null}}])");
    EXPECT_EQ(file.about, "mine");
    EXPECT_EQ(file.transport.bounces, 2);
    EXPECT_THAT(file.transport.parts, ElementsAre("out.x"));
    ASSERT_EQ(file.parameters.size(), 2u);
    EXPECT_EQ(file.parameters[1].name, "scale");
    EXPECT_EQ(std::get<float>(file.parameters[1].default_value), 0.25f);
    EXPECT_EQ(file.parameters[1].max, 1) << "the range stays";
    EXPECT_EQ(file.resources.size(), 3u);
    EXPECT_EQ(resource(file, "a.image").format, "r16");
    EXPECT_EQ(resource(file, "a.image").size.parts[0], "8") << "the size stays";
    EXPECT_TRUE(resource(file, "a.image").overwritten);
    EXPECT_EQ(resource(file, "d.image").format, "r32f");
    EXPECT_EQ(file.nodes[0].params_json, (std::map<std::string, std::string>{{"gain", "5"}}));
    EXPECT_EQ(file.nodes[0].needs, "lights");
    EXPECT_FALSE(file.nodes[0].enabled);
    EXPECT_EQ(file.nodes[0].shader, "a.comp");
    EXPECT_TRUE(file.nodes[1].bind.empty());
}

TEST_F(Overlays, PassesAreAddedMovedAndRemoved) {
    auto entry = [](const std::string& place, const std::string& id) {
        return "{" + place + R"("id":")" + id + R"(","type":"compute","shader":"a.comp"})";
    };
    auto order_with = [&](const std::string& passes) { return ids(read("\"passes\":[" + passes + "]")); };
    EXPECT_THAT(order_with(entry("", "n")), ElementsAre("a", "b", "n")) << "the first goes to the end";
    EXPECT_THAT(order_with(entry("\"before\":\"a\",", "n")), ElementsAre("n", "a", "b"));
    EXPECT_THAT(order_with(entry("\"after\":\"a\",", "n") + "," + entry("", "o")), ElementsAre("a", "n", "o", "b"))
        << "one that names no place follows the entry before it";
    EXPECT_THAT(order_with(R"({"id":"a","enabled":false},)" + entry("", "n")), ElementsAre("a", "n", "b"));
    EXPECT_THAT(order_with(R"({"id":"a","after":"b"})"), ElementsAre("b", "a"));
    EXPECT_THAT(ids(read(R"("remove":["a"])")), ElementsAre("b"));
    EXPECT_THAT(ids(read(R"("remove":["a"],"passes":[)" + entry("\"after\":\"b\",", "a") + "]")), ElementsAre("b", "a"))
        << "another pass of that name";
}

TEST_F(Overlays, ChainsStackAndEachFileIsNamedForWhatItSaid) {
    write("middle", R"("extends":"base","passes":[{"id":"a","params":{"gain":4}}])");
    std::filesystem::path top = write("top", R"("extends":"middle","passes":[{"id":"a","params":{"bias":1}}])");
    GraphFile file = read_graph_file(top);
    EXPECT_EQ(file.nodes[0].params_json, (std::map<std::string, std::string>{{"gain", "4"}, {"bias", "1"}}));
    EXPECT_EQ(file.files.size(), 3u);
    write("middle", R"("extends":"base","resources":{"b.image":{"format":"rgba16g"}})");
    EXPECT_THAT(error_of([&] { read_graph_file(top); }),
                HasSubstr("middle.json: resources.b.image: there is no format 'rgba16g'"));
    write("middle", R"("extends":"base","passes":[{"id":"a","params":{"gian":4}}])");
    EXPECT_THAT(error_of([&] { GraphModel model(read_graph_file(top)); }), HasSubstr("did you mean 'gain'"));
}

TEST_F(Overlays, ABaseIsFoundBesideTheFileAndAmongTheGraphs) {
    TempFolder folder;
    folder.write("mine.json", R"({"version":1,"extends":"base"})");
    EXPECT_EQ(read_graph_file(folder / "mine.json").about, "the base");
    folder.write("base.json", R"({"version":1,"extends":"base","about":"over the graph of that name"})");
    EXPECT_EQ(read_graph_file(folder / "mine.json").about, "over the graph of that name");
    folder.write("sub/deep.json", R"({"version":1,"extends":"../mine.json"})");
    EXPECT_EQ(read_graph_file(folder / "sub/deep.json").files.size(), 4u);
    EXPECT_EQ(extends_name(folder / "mine.json", folder / "sub/other.json"), "../mine.json");
    EXPECT_EQ(extends_name(root / "assets/graphs/base.json", root / "assets/graphs/other.json"), "base");
    EXPECT_EQ(find_graph((folder / "mine").string()), folder / "mine.json") << "a preset is a graph, by path, too";
}

TEST_F(Overlays, WhatIsWrongIsOneClearError) {
    EXPECT_THAT(problem(R"("passes":[{"id":"aa","enabled":false}])"),
                HasSubstr("graph 'g': g.json: pass 'aa': there is no such pass to change"));
    EXPECT_THAT(problem(R"("passes":[{"id":"a","type":"compute"}])"), HasSubstr("pass 'a': is there already"));
    EXPECT_THAT(problem(R"("remove":["c"])"), HasSubstr("remove: there is no pass 'c'"));
    EXPECT_THAT(problem(R"("passes":[{"id":"a","params":{"gian":null}}])"),
                HasSubstr("pass 'a'.params: there is no 'gian' to take away (did you mean 'gain'?)"));
    EXPECT_THAT(problem(R"("resources":{"a.imgae":null})"), HasSubstr("(did you mean 'a.image'?)"));
    EXPECT_THAT(problem(R"("parameters":{"scal":null})"), HasSubstr("(did you mean 'scale'?)"));
    EXPECT_THAT(problem(R"("passes":[{"id":"a","before":"x"}])"), HasSubstr("'before' names no pass: 'x'"));
    EXPECT_THAT(problem(R"("passes":[{"id":"a","before":"b","after":"b"}])"), HasSubstr("not both"));
    EXPECT_THAT(problem(R"("pases":[])"), HasSubstr("there is no key 'pases' (did you mean 'passes'?)"));
    EXPECT_THAT(problem(R"("passes":[{"id":"a","enabeld":false}])"),
                HasSubstr("g.json: pass 'a': there is no key 'enabeld' (did you mean 'enabled'?)"));
    EXPECT_THAT(problem(R"("passes":3)"), HasSubstr("passes: must be a list"));
    EXPECT_THAT(problem(R"("resources":[1])"), HasSubstr("resources: must be an object"));
    EXPECT_THAT(problem(R"("remove":["c"],"passes":[{"id":"aa"}])"), HasSubstr(": 2 errors\n"));
    EXPECT_THAT(error_of([&] { read_graph_file(write("h", R"("extends":"bas")")); }),
                AllOf(HasSubstr("h.json: there is no graph 'bas' to extend"), HasSubstr("did you mean 'base'?")));
    EXPECT_THAT(error_of([&] { read_graph_file(write("h", R"("extends":3)")); }), HasSubstr("'extends' must be"));
    root.write("assets/graphs/h.json", R"({"extends":"base"})");
    EXPECT_THAT(error_of([&] { read_graph_file(root / "assets/graphs/h.json"); }), HasSubstr("'version' must be 1"));
    EXPECT_THAT(error_of([&] { plan(R"("before":"x","passes":[{"type":"gbuffer"}])"); }), HasSubstr("no key 'before'"))
        << "a graph that extends nothing has nothing to stand before";
}

TEST_F(Overlays, WhatIsVeryLongOrOddIsOneClearErrorToo) {
    const std::string name(26000, 'x');
    auto refused = [&](const std::string& members) { return error_of([&] { read_graph_file(write("h", members)); }); };
    EXPECT_THAT(refused("\"extends\":\"" + name + "\""),
                AllOf(HasSubstr("to extend"), testing::SizeIs(testing::Lt(400u))));
    for (const std::string& members :
         {"\"remove\":[\"" + name + "\"]", "\"passes\":[{\"id\":\"" + name + "\"}]", "\"" + name + "\":1",
          "\"passes\":[{\"id\":\"a\",\"after\":\"" + name + "\"}]", "\"resources\":{\"" + name + "\":null}"})
        EXPECT_THAT(problem(members), testing::SizeIs(testing::AllOf(testing::Gt(20u), testing::Lt(600u))));
    write("h0", R"("extends":"base")");
    for (int i = 1; i <= 40; ++i)
        write(fmt::format("h{}", i), fmt::format("\"extends\":\"h{}\"", i - 1));
    EXPECT_EQ(read_graph_file(root / "assets/graphs/h20.json").nodes.size(), 2u);
    EXPECT_THAT(error_of([&] { read_graph_file(root / "assets/graphs/h40.json"); }),
                HasSubstr("more than 32 graphs extend one another"));
    EXPECT_EQ(graph_chain(root / "assets/graphs/h40.json").size(), 32u);
    for (const char* text : {"[]", "3", "null", R"({"version":1,"passes":{}})", R"({"version":1,"passes":[3]})"}) {
        root.write("assets/graphs/odd.json", text);
        EXPECT_NE(refused(R"("extends":"odd","passes":[{"id":"a","params":{"x":1}}])"), "") << text;
    }
    EXPECT_THAT(problem(R"("passes":[3],"parameters":{"scale":3},"transport":[])"), HasSubstr("must be an object"));
    EXPECT_THAT(problem(R"("passes":[{"id":"a","params":3,"bind":[]}])"), HasSubstr("must be an object"));
}

TEST_F(Overlays, ACircleIsNamed) {
    write("one", R"("extends":"two")");
    write("two", R"("extends":"three")");
    std::filesystem::path three = write("three", R"("extends":"one")");
    EXPECT_THAT(error_of([&] { read_graph_file(three); }),
                HasSubstr("in a circle: three.json → one.json → two.json → three.json"));
    EXPECT_THAT(error_of([&] { read_graph_file(write("self", R"("extends":"self")")); }),
                HasSubstr("in a circle: self.json → self.json"));
    EXPECT_EQ(graph_chain(three).size(), 3u);
}

// --- from two graphs to the overlay between them ---------------------------------------------------------------------

static OrderedJson applied(const OrderedJson& base, OrderedJson overlay) {
    WholeGraph graph{base, {}, {}};
    overlay["version"] = 1;
    apply_overlay(graph, overlay, "test.json");
    return graph.root;
}

static OrderedJson random_graph(std::mt19937& random) {
    auto below = [&](unsigned n) { return random() % n; };
    OrderedJson root = {{"version", 1}, {"about", std::string(1, char('a' + below(3)))}};
    for (int i = 0; i < 3; ++i) {
        if (below(2)) root["transport"]["t" + std::to_string(below(3))] = below(3);
        if (below(2)) root["parameters"]["p" + std::to_string(below(3))]["default"] = below(3);
        if (below(2))
            root["resources"]["r.r" + std::to_string(below(3))] = {{"f" + std::to_string(below(2)), below(3)}};
    }
    std::vector<std::string> ids = {"a", "b", "c", "d", "e", "f"};
    std::shuffle(ids.begin(), ids.end(), random);
    ids.resize(1 + below(6));
    for (const std::string& id : ids) {
        OrderedJson entry = {{"id", id}, {"type", below(4) ? "x" : "y"}};
        if (below(3) == 0) entry.erase("id"), entry["type"] = id;
        for (const char* part : {"params", "bind"})
            for (int i = 0; i < 2; ++i)
                if (below(2)) entry[part]["k" + std::to_string(below(3))] = below(3);
        if (below(2)) entry["needs"] = std::to_string(below(2));
        root["passes"].push_back(entry);
    }
    return root;
}

/// Passes in order; members have none, an empty object is none, and a pass's id may be left out where it is its type.
static nlohmann::json comparable(const OrderedJson& root) {
    nlohmann::json out = root;
    for (const char* key : {"transport", "parameters", "resources"})
        if (out.contains(key) && out[key].empty()) out.erase(key);
    for (nlohmann::json& entry : out["passes"]) {
        entry["id"] = entry.value("id", entry["type"].get<std::string>());
        for (const char* key : {"params", "bind"})
            if (entry.contains(key) && entry[key].empty()) entry.erase(key);
    }
    return out;
}

TEST(Departures, OneGraphExtendedByThemIsTheOther) {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        OrderedJson from = random_graph(random), to = random_graph(random);
        OrderedJson overlay = graph_departures(from, to);
        ASSERT_EQ(comparable(applied(from, overlay)), comparable(to))
            << "from " << from.dump() << "\nto " << to.dump() << "\nby " << overlay.dump();
        EXPECT_TRUE(graph_departures(to, to).empty());
    }
}

TEST(Departures, SayOnlyWhatDiffers) {
    OrderedJson from =
        OrderedJson::parse(R"({"version":1,"passes":[{"type":"a","params":{"x":1,"y":2}},{"type":"b"},{"type":"c"}]})");
    OrderedJson to = OrderedJson::parse(
        R"({"version":1,"passes":[{"type":"a","params":{"x":1,"y":3}},{"id":"n","type":"m"},{"type":"c"}]})");
    EXPECT_EQ(graph_departures(from, to), OrderedJson::parse(R"({"remove":["b"],
        "passes":[{"id":"a","params":{"y":3}},{"id":"n","type":"m"}]})"));
}

TEST(Departures, ShippedGraphsAreWhatTheirDifferencesSay) {
    std::vector<OrderedJson> graphs;
    for (const auto& entry : std::filesystem::directory_iterator(real_root() / "assets/graphs"))
        if (entry.path().extension() == ".json") graphs.push_back(expand_graph(entry.path()).root);
    ASSERT_GE(graphs.size(), 15u);
    for (const OrderedJson& from : graphs)
        for (const OrderedJson& to : graphs)
            EXPECT_EQ(comparable(applied(from, graph_departures(from, to))), comparable(to));
}

TEST(Departures, TheTextReadsBackAndKeepsWithin140Columns) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(real_root() / "assets/graphs")) {
        if (entry.path().extension() != ".json") continue;
        OrderedJson root = expand_graph(entry.path()).root;
        std::string text = graph_text(root);
        EXPECT_EQ(OrderedJson::parse(text), root);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }), 140) << line;
    }
}
