// Presets: graphs that extend the loaded one by what the panels say.
#include "app/graph_preset.h"
#include "app/session.h"
#include "graph/graph_overlay.h"
#include "support/errors.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class GraphPreset : public GpuTest {
  protected:
    SessionOptions options(const std::string& graph) {
        TinyScene().quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}).write(root.path(), "tiny");
        SessionOptions out;
        out.shot = write_shot(root.path(), "tiny", "tiny.gltf", {0.4f, 1, 2}, {0, 0.2f, 0},
                              R"({"type":"point","position":[-0.7,1,0.4],"intensity":2})");
        out.graph = graph;
        out.size = {16, 9};
        return out;
    }
    static void panel(Session& session, const std::string& name, const std::string& value) {
        session.set_parameter(name, value, ParameterOrigin::panel);
    }
    /// Every value and switch of a graph, by name.
    static std::map<std::string, std::string> values(const GraphModel& model) {
        std::map<std::string, std::string> out;
        for (const std::string& name : model.parameter_names())
            out[name] = model.parameter(name).text();
        for (const auto& node : model.nodes())
            out[node->id()] = node->enabled ? "on" : "off";
        return out;
    }
    std::filesystem::path graph(const std::string& name) const { return root / ("assets/graphs/" + name + ".json"); }
    TempRoot root;
};

TEST_F(GraphPreset, IsAGraphThatExtendsTheLoadedOneByWhatDiffers) {
    Session session(options("dvs_tuned"));
    panel(session, "gather.spiral_cones", "8");
    panel(session, "graph.scale", "0.25");
    panel(session, "voxel_bounce.exact_hits", "false"); // the file has it on, and off is its default
    panel(session, "tonemap.exposure", "0");            // as it was
    session.graph().model().switch_pass("view_cubes", true);
    save_graph_preset(session, "mine", false);
    OrderedJson saved = parse_graph_text(graph("mine"));
    EXPECT_EQ(saved["extends"], "dvs_tuned");
    EXPECT_EQ(nlohmann::json(saved["parameters"]), nlohmann::json::parse(R"({"scale":{"default":0.25}})"));
    EXPECT_EQ(nlohmann::json(saved["passes"]), nlohmann::json::parse(R"([
        {"id":"voxel_bounce","params":{"exact_hits":false}},{"id":"gather","params":{"spiral_cones":8}},
        {"id":"view_cubes","enabled":true}])"));
    EXPECT_EQ(values(GraphModel(read_graph_file(graph("mine")))), values(session.graph().model()));
    // By path, too, from anywhere.
    TempFolder elsewhere;
    save_graph_preset(session, (elsewhere / "there.json").string(), false);
    EXPECT_EQ(values(GraphModel(read_graph_file(elsewhere / "there.json"))), values(session.graph().model()));
    session.open_graph((elsewhere / "there").string());
    panel(session, "gather.spiral_cones", "12");
    save_graph_preset(session, (elsewhere / "again").string(), false);
    EXPECT_EQ(parse_graph_text(elsewhere / "again.json")["extends"], "there");
    EXPECT_EQ(values(GraphModel(read_graph_file(elsewhere / "again.json"))), values(session.graph().model()));
}

TEST_F(GraphPreset, OverItsOwnFileKeepsWhatAPersonWroteThere) {
    const std::string text =
        "// Mine.\n{\n  \"version\": 1, \"extends\": \"direct\",\n  \"passes\": [\n"
        "    // Bright.\n    { \"id\": \"tonemap\", \"params\": { \"exposure\": 2 } } // two stops\n  ]\n}\n";
    root.write("assets/graphs/mine.json", text);
    Session session(options("mine"));
    EXPECT_THAT(error_of([&] { save_graph_preset(session, "mine", false); }), HasSubstr("overwrite"));
    save_graph_preset(session, "mine", true);
    EXPECT_EQ(root.read("assets/graphs/mine.json"), text) << "nothing differs";
    panel(session, "tonemap.exposure", "3");
    panel(session, "shadow_maps.resolution", "256");
    session.graph().model().switch_pass("emission", false);
    save_graph_preset(session, "mine", true);
    EXPECT_EQ(root.read("assets/graphs/mine.json"),
              "// Mine.\n{\n  \"version\": 1, \"extends\": \"direct\",\n  \"passes\": [\n"
              "    // Bright.\n    { \"id\": \"tonemap\", \"params\": { \"exposure\": 3 } }, // two stops\n"
              "    { \"id\": \"shadow_maps\", \"params\": { \"resolution\": 256 } },\n"
              "    { \"id\": \"emission\", \"enabled\": false }\n  ]\n}\n");
    EXPECT_EQ(values(GraphModel(read_graph_file(graph("mine")))), values(session.graph().model()));
    EXPECT_THAT(error_of([&] { save_graph_preset(session, "direct", true); }),
                HasSubstr("the loaded graph extends it"));
    EXPECT_THAT(root.read("assets/graphs/direct.json"), Not(HasSubstr("exposure")));
}
