// Values that follow the scene's needs, in whole graphs and on a shot.
#include "app/session.h"
#include "core/asset_files.h"
#include "reference/scene_needs.h"
#include "support/gpu_context.h"

#include <gmock/gmock.h>

namespace bounce {
namespace {

template <class Visit>
void for_each_parameter(const GraphModel& model, Visit&& visit) {
    for (const std::string& name : model.parameter_names())
        visit(name, model.parameter(name));
}

} // namespace

TEST(AutoValues, EveryNeedThatIsFollowedIsKnown) {
    const SceneNeeds needs = needs_of({}, 1);
    for (const std::string& graph : asset_names("graphs")) {
        const GraphModel model(read_graph_file(find_graph(graph)));
        for_each_parameter(model, [&](const std::string& name, const Parameter& p) {
            if (p.info.automatic.empty()) return;
            EXPECT_TRUE(needs.contains(p.info.automatic)) << graph << ": " << name << " follows " << p.info.automatic;
        });
    }
}

TEST(AutoValues, PublishedGraphsHaveFixedOnes) {
    for (const char* graph : {"lrsm", "dvs", "vct", "vf", "ism", "rsm", "ldm_ao", "ldm_indirect", "lpv"})
        EXPECT_FALSE(GraphModel(read_graph_file(find_graph(graph))).has_auto()) << graph;
    for (const char* graph : {"lrsm_tuned", "dvs_tuned", "vct_tuned", "vf_tuned", "lpv_tuned", "ldm_indirect_tuned"})
        EXPECT_TRUE(GraphModel(read_graph_file(find_graph(graph))).has_auto()) << graph;
}

TEST(AutoValues, FinerScenesNeedMore) {
    FeatureSizes coarse, fine;
    coarse.gap_10 = 4, fine.gap_10 = 0.5f;
    coarse.area = fine.area = 3000;
    coarse.ray_variance = 3, fine.ray_variance = 6;
    const SceneNeeds few = needs_of(coarse, 20), many = needs_of(fine, 20);
    for (const auto& [name, need] : few) {
        if (name == "axes")
            EXPECT_GT(need.value, many.at(name).value) << "the maps' texels are what is too coarse then";
        else
            EXPECT_LT(need.value, many.at(name).value) << name;
        EXPECT_THAT(need.reason, testing::HasSubstr(name == "cones" ? "one ray" : "within 4 m")) << name;
    }
    EXPECT_EQ(few.at("voxels").value, 128)
        << "5 voxels in each of 5 gaps are 32 as a power of two, which the rule does not go below 128 for";
    EXPECT_THAT(needs_of(fine, 2000).at("voxels").reason, testing::HasSubstr("no more than 256"));
}

class AutoSession : public GpuTest {};

TEST_F(AutoSession, AShotGivesValuesWithReasons) {
    SessionOptions options;
    options.shot = "cornell";
    options.graph = "lrsm_tuned";
    options.size = glm::ivec2(16);
    Session session(options);
    const GraphModel& model = session.graph().model();
    EXPECT_FALSE(model.has_auto(true));
    const Parameter& texels = model.parameter("rsm.resolution");
    EXPECT_EQ(texels.text(), "auto");
    EXPECT_NE(texels.reason, "");
    EXPECT_EQ(std::get<int>(texels.value), int(session.needs().at("map_texels").value));
    EXPECT_EQ(session.graph().plan().find_resource("rsm.depth")->texture.size.x, std::get<int>(texels.value));
    // Another scene, another value.
    session.open_shot("atrium");
    EXPECT_GT(std::get<int>(model.parameter("rsm.resolution").value), 256);
    session.set_parameter("rsm.resolution", "64", ParameterOrigin::panel);
    session.set_parameter("rsm.resolution", "auto", ParameterOrigin::panel);
    EXPECT_GT(std::get<int>(model.parameter("rsm.resolution").value), 256);
    EXPECT_THAT(session.command_line("a.exr"), testing::HasSubstr("--set rsm.resolution=auto"));
    session.open_graph("dvs_tuned");
    EXPECT_FALSE(session.graph().model().has_auto(true));
}

TEST_F(AutoSession, ALightThatIsMovedOrChangedGivesOthers) {
    SessionOptions options;
    options.shot = "cornell";
    options.graph = "dvs_tuned";
    options.size = glm::ivec2(16);
    Session session(options);
    const auto cones = [&] { return std::get<int>(session.graph().model().parameter("gather.spiral_cones").value); };
    const int before = cones();
    EXPECT_FALSE(session.measure_moved_needs());
    Light& light = session.shot().scene.lights.front();
    light.outer_cone = 0.05f; // a small spot: few rays meet what is lit
    light.inner_cone = 0.04f;
    session.scene_edited();
    EXPECT_TRUE(session.measure_moved_needs());
    EXPECT_FALSE(session.measure_moved_needs());
    EXPECT_GT(cones(), before);
    for (Node& node : session.shot().scene.nodes)
        if (node.light >= 0) node.translation.x += 0.5;
    EXPECT_TRUE(session.measure_moved_needs());
}

} // namespace bounce
