// Where the gathers of voxel methods take exact hits: with the same directions they find what traced rays find.
#include "app/experiments/sweep.h"
#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace bounce;

namespace {

using Picture = std::vector<float>;

class TracedHits : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        // A room that is open to the viewer, with a box in it: nothing emits.
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.7f, 0.6f, 0.5f})
            .quad({-1, 0, -1}, {1, 0, -1}, {1, 1.5f, -1}, {-1, 1.5f, -1}, {0.6f, 0.6f, 0.7f})
            .quad({-1, 0, 1}, {-1, 0, -1}, {-1, 1.5f, -1}, {-1, 1.5f, 1}, {0.7f, 0.2f, 0.2f})
            .quad({1, 0, -1}, {1, 0, 1}, {1, 1.5f, 1}, {1, 1.5f, -1}, {0.2f, 0.7f, 0.2f})
            .box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f}, {0.4f, 0.5f, 0.8f})
            .write(folder.path(), "room");
        shot = write_shot(folder.path(), "room", "room.gltf", {0.1f, 0.9f, 2.6f}, {0, 0.5f, 0},
                          R"({"type":"spot","position":[0.3,1.4,0.7],"direction":[-0.2,-1,-0.3],)"
                          R"("intensity":6,"outer_cone_deg":60})");
    }

    /// A resource after one frame at 48 × 48. `counts`: parameters of rays are set to 16.
    Picture rendered(const std::string& graph, const std::string& resource, ParameterValues sets) const {
        SessionOptions options;
        options.shot = shot;
        options.graph = graph;
        options.size = {48, 48};
        options.sets = std::move(sets);
        options.resource = resource;
        Session session(options);
        session.render(true);
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << graph << ": " << problem.error.text();
        return session.graph().texture(resource)->read();
    }

    TempFolder folder;
    std::string shot;
};

double mean_of(const Picture& picture) {
    double sum = 0;
    for (size_t i = 0; i < picture.size(); ++i)
        if (i % 4 < 3) sum += picture[i];
    return sum / (double(picture.size()) * 0.75);
}

/// Root of the mean square of the differences of RGB, as a share of the mean of b.
double relative_rmse(const Picture& a, const Picture& b) {
    double sum = 0;
    for (size_t i = 0; i < b.size(); ++i)
        if (i % 4 < 3) sum += std::pow(double(a.at(i)) - double(b[i]), 2);
    return std::sqrt(sum / (double(b.size()) * 0.75)) / mean_of(b);
}

const std::pair<std::string, std::string> k_one_bounce{"voxel_bounce.bounces", "1"};

} // namespace

TEST_F(TracedHits, DvsGathersWhatTracedRaysGather) {
    const Picture truth = rendered("traced", "traced.irradiance", {{"gather.rays", "16"}});
    const Picture dvs = rendered("dvs_traced", "dvs.irradiance",
                                 {k_one_bounce, {"gather.spiral_cones", "16"}, {"shadow_maps.resolution", "2048"}});
    ASSERT_GT(mean_of(truth), 0);
    EXPECT_LT(relative_rmse(dvs, truth), 1e-3);
}

TEST_F(TracedHits, NearTrianglesThatReachAllAreTriangles) {
    const Picture all = rendered("dvs_traced", "dvs.irradiance", {k_one_bounce});
    const Picture near = rendered("dvs_traced", "dvs.irradiance",
                                  {k_one_bounce, {"gather.hit", "near_triangle"}, {"gather.near_share", "1"}});
    EXPECT_EQ(near, all);
    const Picture lrsm = rendered("lrsm_traced", "lrsm.irradiance", {});
    // Without voxels, lengths in voxels count in gather.map_voxels: 128.
    EXPECT_EQ(
        rendered("lrsm_traced", "lrsm.irradiance",
                 {{"gather.hit", "near_triangle"}, {"gather.near_share", "1"}, {"occlusion_voxels.resolution", "128"}}),
        lrsm);
}

/// The voxels' own coarseness is what triangles take away.
TEST_F(TracedHits, AreNearerToTheTruthThanVoxelsAre) {
    const Picture truth = rendered("traced", "traced.irradiance", {{"gather.rays", "16"}});
    double last = 1e9;
    for (const char* hit : {"voxel", "near_triangle", "triangle"}) {
        const Picture found = rendered("dvs_traced", "dvs.irradiance",
                                       {k_one_bounce,
                                        {"gather.spiral_cones", "16"},
                                        {"voxelization.resolution", "32"},
                                        {"gather.hit_lookup", "voxels"},
                                        {"gather.hit", hit},
                                        {"gather.near_share", "0.2"}});
        const double error = relative_rmse(found, truth);
        EXPECT_LT(error, last) << hit;
        last = error;
    }
}

TEST_F(TracedHits, LrsmFindsItsLightInTheMaps) {
    const Picture truth = rendered("traced", "traced.irradiance", {{"gather.rays", "16"}});
    const Picture lrsm = rendered("lrsm_traced", "lrsm.irradiance", {{"gather.spiral_cones", "16"}});
    EXPECT_NEAR(mean_of(lrsm) / mean_of(truth), 1, 0.12);
}

/// With a second bounce between coarse voxels there is more light, by about what surfaces send back of the first.
TEST_F(TracedHits, TheSecondBounceComesFromVoxels) {
    const Picture one = rendered("dvs_traced", "dvs.irradiance", {k_one_bounce, {"gather.spiral_cones", "32"}});
    const Picture two = rendered("dvs_traced", "dvs.irradiance", {{"gather.spiral_cones", "32"}});
    const Picture truth = rendered("traced", "traced.irradiance", {{"gather.rays", "32"}, {"gather.bounces", "2"}});
    EXPECT_GT(mean_of(two), 1.05 * mean_of(one));
    EXPECT_NEAR(mean_of(two) / mean_of(truth), 1, 0.06);
}

/// Published graphs march cones: no tree is built for them.
TEST_F(TracedHits, AreOffAsPublished) {
    for (const char* graph : {"dvs", "vct", "lrsm"}) {
        SessionOptions options;
        options.shot = shot;
        options.graph = graph;
        options.size = {16, 16};
        Session session(options);
        const std::vector<PlanPass>& passes = session.graph().plan().passes;
        EXPECT_TRUE(std::none_of(passes.begin(), passes.end(), [](const PlanPass& p) { return p.id == "bvh"; }))
            << graph;
    }
}
