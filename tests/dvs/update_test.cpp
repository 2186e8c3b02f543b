// What is computed anew, and what is left out: static voxels when they change and never else, nothing dynamic where
// nothing moves, no emission without emissive materials, no bounce where one is asked for.
#include "support/scene_runner.h"

#include <gmock/gmock.h>

using namespace bounce;

namespace {

const char* const k_graph =
    R"("passes":[{"type":"shadow_maps","params":{"resolution":64}},
        {"type":"voxelization","params":{"resolution":32,"averaging":"sum","route":"compute"}},{"type":"voxel_direct"}])";

Scene room() {
    return MadeScene()
        .quad({-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}, {0.8f, 0.8f, 0.8f})
        .quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, {0.3f, 0.3f, 0.3f})
        .box({-0.4f, -0.3f, -0.2f}, {-0.1f, 0.1f, 0.2f}, {0.9f, 0.2f, 0.1f})
        .scene;
}

std::vector<std::string> programs_of(const Plan& plan, const std::string& id) {
    for (const PlanPass& pass : plan.passes)
        if (pass.id == id) return pass.programs;
    return {};
}

using Sets = std::vector<std::pair<std::string, std::string>>;

class VoxelUpdate : public SceneGraphTest {
  protected:
    /// The graph as it ships.
    static std::filesystem::path shipped(const std::string& name) {
        return std::filesystem::path(BOUNCE_TESTS_DIR) / "../assets/graphs" / (name + ".json");
    }
};

} // namespace

/// A mark that the test leaves in the volume is still there as long as nothing is voxelized.
TEST_F(VoxelUpdate, StaticVoxelsAreMadeAgainExactlyWhenTheyChange) {
    SceneRunner run(room(), {directional_light({1, -0.1f, 0.2f}, {1, 1, 1})}, graph_file(k_graph));
    run.frame();
    std::vector<float> made = run.read("voxels.albedo");
    run.texture("voxels.albedo").clear(glm::vec4(0.25f, 0.5f, 0.75f, 1));
    std::vector<float> marked = run.read("voxels.albedo");
    ASSERT_NE(marked, made);

    std::vector<float> radiance = run.read("dvs.radiance");
    run.set_lights({directional_light({1, -0.4f, 0}, {2, 1, 1})});
    run.frame();
    EXPECT_EQ(run.read("voxels.albedo"), marked) << "another light";
    EXPECT_NE(run.read("dvs.radiance"), radiance) << "is another light at the voxels";
    run.set_lights({directional_light({1, -0.4f, 0}, {2, 1, 1}), point_light({0, 0.5f, 0}, {1, 2, 3})});
    run.frame();
    EXPECT_EQ(run.read("voxels.albedo"), marked) << "one more light";
    run.camera.position = {1, 2, 3};
    run.frame();
    run.set("voxel_direct.attenuation", "normal_weighted");
    run.set("voxel_direct.occlusion", "ray_hard");
    run.frame();
    EXPECT_EQ(run.read("voxels.albedo"), marked) << "another camera, other parameters of the light";

    run.set("voxelization.leaf_threshold", "0.4");
    run.frame();
    EXPECT_EQ(run.read("voxels.albedo"), made) << "a parameter of the voxels";
    run.texture("voxels.albedo").clear(glm::vec4(0.25f, 0.5f, 0.75f, 1));
    run.state.instances[1].world[3].y = -0.6f;
    run.frame();
    SceneRunner fresh(room(), {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(k_graph));
    fresh.state.instances[1].world[3].y = -0.6f;
    fresh.frame();
    EXPECT_EQ(run.read("voxels.albedo"), fresh.read("voxels.albedo")) << "a static instance moved";
}

/// Of two parts, one moves: the other one's voxels keep the mark.
TEST_F(VoxelUpdate, WhatMovesDoesNotTouchWhatStands) {
    SceneRunner run(room(), {directional_light({0, -1, 0.2f}, {1, 1, 1})}, graph_file(k_graph));
    auto move = [&](float by) {
        for (size_t i = 2; i < run.state.instances.size(); ++i) {
            run.state.instances[i].dynamic = true;
            run.state.instances[i].world[3].x = by;
        }
        run.facts.dynamic_instances = run.state.instances.size() - 2;
        run.frame();
    };
    move(0);
    std::vector<float> flags = run.read("voxels.flags"), before = run.read("voxels.albedo");
    run.texture("voxels.albedo").clear(glm::vec4(0.25f, 0.5f, 0.75f, 1));
    move(0.31f);
    std::vector<float> after = run.read("voxels.albedo"), flags_after = run.read("voxels.flags");
    int stands = 0, cleared = 0, made = 0;
    for (size_t i = 0; i < flags.size(); ++i) {
        int was = int(flags[i]) & 3, is = int(flags_after[i]) & 3;
        if (was == 1) {
            ++stands;
            ASSERT_EQ(is, 1);
            ASSERT_NEAR(after[4 * i], 0.25f, 0.01f) << "a static voxel was written";
        } else if (is == 2) {
            ++made;
            ASSERT_NEAR(after[4 * i], 0.9f, 0.01f);
        } else if (was == 2) {
            ++cleared;
            ASSERT_EQ(after[4 * i + 3], 0);
        }
    }
    EXPECT_GT(stands, 1500);
    EXPECT_GT(cleared, 50);
    EXPECT_GT(made, 100);
}

TEST_F(VoxelUpdate, GraphsLeaveOutWhatTheSceneDoesNotNeed) {
    for (const char* name : {"dvs", "dvs_tuned", "vct", "vct_tuned"}) {
        SceneRunner run(room(), {directional_light({0, -1, 0.2f}, {1, 1, 1})}, shipped(name),
                        {{"voxelization.resolution", "32"}});
        run.frame();
        const Plan& plan = run.graph.plan();
        EXPECT_EQ(plan.find_resource("voxels.emission"), nullptr) << name;
        EXPECT_EQ(plan.find_resource("voxels.packed_emission"), nullptr) << name;
        EXPECT_THAT(programs_of(plan, "voxelization"), testing::Not(testing::Contains("clear_dynamic"))) << name;
        EXPECT_THAT(plan_text(run.graph.model(), plan), testing::HasSubstr("voxels.emission (neutral 0)")) << name;
        EXPECT_THAT(plan_text(run.graph.model(), plan), testing::Not(testing::HasSubstr("clear_dynamic"))) << name;

        run.facts.dynamic_instances = 1;
        run.facts.emissive_materials = 1;
        run.graph.prepare(run.facts, run.size);
        EXPECT_NE(run.graph.plan().find_resource("voxels.emission"), nullptr) << name;
        EXPECT_THAT(programs_of(run.graph.plan(), "voxelization"), testing::Contains("clear_dynamic")) << name;
        EXPECT_THAT(plan_text(run.graph.model(), run.graph.plan()), testing::HasSubstr("clear_dynamic")) << name;
    }
}

/// With one bounce nothing is gathered between voxels, and the graph is VCT.
TEST_F(VoxelUpdate, OneBounceNeedsNoneBetweenVoxels) {
    std::vector<std::vector<float>> pictures;
    for (const char* name : {"dvs", "vct"}) {
        Sets sets{{"voxelization.resolution", "32"}, {"voxelization.averaging", "sum"}};
        if (name == std::string("dvs")) sets.emplace_back("voxel_bounce.bounces", "1");
        SceneRunner run(room(), {directional_light({0.5f, -1, 0.2f}, {1, 1, 1})}, shipped(name), sets, {32, 32});
        run.camera.position = {0.2f, 0.4f, 3.1f};
        run.frame();
        pictures.push_back(run.read("out.indirect_diffuse"));
        if (name != std::string("dvs")) continue;
        const Plan& plan = run.graph.plan();
        EXPECT_EQ(plan.find_resource("dvs.bounced"), nullptr);
        EXPECT_THAT(programs_of(plan, "voxel_bounce"), testing::IsEmpty());
        EXPECT_THAT(programs_of(plan, "filter_bounced"), testing::IsEmpty());
        EXPECT_THAT(plan_text(run.graph.model(), plan),
                    testing::HasSubstr("voxel_bounce: requires voxel_bounce.bounces > 1"));
    }
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_GT(*std::max_element(pictures[0].begin(), pictures[0].end()), 0.001f);
}
