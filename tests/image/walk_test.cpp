// Walks over reflective shadow maps in a scene that no light lights: what surfaces emit is the voxels' own, and stays.
#include "app/session.h"
#include "support/gpu_context.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace bounce;

class Walks : public GpuTest {
  protected:
    static std::vector<float> seen(const char* graph, const char* hit_lookup) {
        SessionOptions options;
        options.shot = "strip_4";
        options.graph = graph;
        options.size = {48, 27};
        options.sets = {{"voxelization.resolution", "32"}, {"gather.hit", "plane"}, {"gather.hit_lookup", hit_lookup}};
        Session session(options);
        session.render();
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
        return session.graph().texture("out.indirect_diffuse")->read();
    }
};

TEST_F(Walks, KeepWhatSurfacesEmit) {
    for (const char* graph : {"dvs_tuned", "vct_tuned"}) {
        std::vector<float> by_voxels = seen(graph, "voxels"), by_walks = seen(graph, "map");
        float brightest = 0;
        for (size_t i = 0; i < by_voxels.size(); ++i) {
            brightest = std::max(brightest, by_voxels[i]);
            ASSERT_NEAR(by_walks[i], by_voxels[i], 2e-3f * by_voxels[i] + 1e-5f)
                << graph << ", value " << i; // half floats
        }
        EXPECT_GT(brightest, 0.01f);
    }
}
