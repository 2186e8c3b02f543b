// The views of the volumes of DVS show what is in them: albedo, normals, emission, radiance, the six directions at
// their mips, static and dynamic voxels, and how many fragments each was made of.
#include "app/session.h"
#include "image/cubes_oracle.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <gmock/gmock.h>

using namespace bounce;

namespace {

constexpr int k_side = 32;

class VoxelViews : public GpuTest {
  protected:
    /// A floor, a glowing wall and, moving, a box.
    void open(const std::string& graph, std::vector<std::pair<std::string, std::string>> sets) {
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.7f, 0.6f, 0.5f})
            .quad({-1, 0, 1}, {-1, 0, -1}, {-1, 1, -1}, {-1, 1, 1}, {0.8f, 0.2f, 0.1f})
            .emission({0.2f, 0.6f, 0.4f})
            .write(folder.path(), "room");
        TinyScene().box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f}, {0.4f, 0.5f, 0.8f}).write(folder.path(), "box");
        SessionOptions options;
        options.shot = write_shot(
            folder.path(), "views", "room.gltf", {1.4f, 1.1f, 2.4f}, {0, 0.2f, 0},
            R"({"type":"directional","direction":[-0.7,-1,-0.2],"intensity":3})",
            R"(,"objects":[{"scene":"box.gltf","path":[{"t":0,"position":[0,0,0]},{"t":1,"position":[0.3,0,0]}]}])");
        options.graph = graph;
        options.size = {48, 40};
        options.sets = {{"voxelization.resolution", "32"}, {"gather.max_steps", "1"}, {"view_cubes.edges", "0"}};
        options.sets.insert(options.sets.end(), sets.begin(), sets.end());
        options.resource = "debug.voxels";
        session = std::make_unique<Session>(options);
    }
    std::vector<float> render(const std::string& quantity, int mip = 0) {
        session->set_parameter("view_cubes.quantity", quantity, ParameterOrigin::panel);
        session->set_parameter("view_cubes.mip", std::to_string(mip), ParameterOrigin::panel);
        session->render();
        for (const GraphProblem& problem : session->graph().problems())
            ADD_FAILURE() << problem.error.text();
        return read("debug.voxels");
    }
    std::vector<float> read(const std::string& name, int mip = 0) const {
        return session->graph().texture(name)->read(mip);
    }
    void expect(const std::string& quantity, const std::vector<DrawnCube>& cubes, const std::vector<float>& shown,
                int side = k_side) {
        VoxelGrid grid(session->facts().bounds_over_animation, k_side);
        CubesVerdict verdict = judge_cubes(shown, session->size(), session->constants(), grid, side, cubes, 0.01f);
        EXPECT_GT(verdict.hits, 300) << quantity;
        EXPECT_LE(verdict.wrong, 4) << quantity; // rays along an edge
    }

    TempFolder folder;
    std::unique_ptr<Session> session;
};

} // namespace

TEST_F(VoxelViews, AreOffUntilAskedFor) {
    for (const char* graph : {"dvs", "dvs_tuned", "vct", "vct_tuned"}) {
        open(graph, {});
        EXPECT_NE(session->graph().plan().find_resource("debug.voxels"), nullptr) << graph;
        SessionOptions options = session->options();
        options.resource = "";
        Session plain(options);
        EXPECT_EQ(plain.graph().plan().find_resource("debug.voxels"), nullptr) << graph;
        EXPECT_THAT(plain.graph().model().off_for("debug.voxels"), testing::ElementsAre("view_cubes")) << graph;
    }
}

TEST_F(VoxelViews, CubesHoldWhatTheVolumesHold) {
    open("dvs", {{"voxelization.averaging", "sum"}, {"view_cubes.exposure", "2"}});
    struct Case {
        const char* quantity;
        const char* volume;
        float scale, offset;
    };
    for (const Case& wanted : {Case{"albedo", "voxels.albedo", 1, 0}, Case{"normal", "voxels.normal", 0.5f, 0.5f},
                               Case{"emission", "voxels.emission", 2, 0}, Case{"radiance", "dvs.bounced", 2, 0}}) {
        std::vector<float> shown = render(wanted.quantity), held = read(wanted.volume), flags = read("voxels.flags");
        std::vector<DrawnCube> cubes;
        for (int i = 0; i < k_side * k_side * k_side; ++i) {
            if (flags[size_t(i)] == 0) continue;
            const float* v = &held[size_t(4 * i)];
            cubes.push_back({{i % k_side, i / k_side % k_side, i / k_side / k_side},
                             wanted.scale * glm::vec3(v[0], v[1], v[2]) + wanted.offset});
        }
        expect(wanted.quantity, cubes, shown);
    }
    const char* const directions[] = {"x", "minus_x", "y", "minus_y", "z", "minus_z"};
    for (int leaf = 0; leaf < 6; ++leaf) {
        for (int mip : {0, 2}) {
            std::vector<float> shown = render(directions[leaf], mip), held = read("dvs.directional", mip);
            int side = 16 >> mip;
            std::vector<DrawnCube> cubes;
            for (int i = 0; i < side * side * side; ++i) {
                glm::ivec3 v(i % side, i / side % side, i / side / side);
                glm::ivec3 at = v + side * glm::ivec3(leaf & 1, leaf / 2, 0);
                const float* texel = &held[4 * size_t(at.x + 2 * side * (at.y + 3 * side * at.z))];
                if (texel[3] > 0.001f) cubes.push_back({v, 2.0f * glm::vec3(texel[0], texel[1], texel[2])});
            }
            expect(directions[leaf], cubes, shown, side);
        }
    }
}

TEST_F(VoxelViews, FlagsAndCollisionsAreTold) {
    for (const char* averaging : {"sum", "gather", "average"}) {
        open("dvs", {{"voxelization.averaging", averaging}, {"voxelization.route", "compute"}});
        std::vector<float> shown = render("flags"), flags = read("voxels.flags");
        std::vector<uint32_t> place = session->graph().texture("voxels.place")->read_integers(), packed;
        std::vector<DrawnCube> kinds, collisions;
        bool packs = averaging == std::string("average");
        if (packs) packed = session->graph().texture("voxels.packed_albedo")->read_integers();
        std::vector<uint32_t> sums;
        if (!packs) sums = session->graph().buffer("voxels.sums")->read_all<uint32_t>();
        int dynamic = 0, several = 0;
        for (int i = 0; i < k_side * k_side * k_side; ++i) {
            int kind = int(flags[size_t(i)]) & 3;
            if (kind == 0) continue;
            glm::ivec3 v(i % k_side, i / k_side % k_side, i / k_side / k_side);
            dynamic += kind == 2;
            kinds.push_back({v, kind == 2 ? glm::vec3(0.95f, 0.5f, 0.1f) : glm::vec3(0.25f, 0.4f, 0.8f)});
            uint32_t fragments = packs ? packed[size_t(i)] >> 24 : sums[13 * (place[size_t(i)] - 1)];
            ASSERT_GT(fragments, 0u);
            several += fragments > 1;
            float heat = std::log2(float(fragments)) / 8;
            collisions.push_back(
                {v, glm::clamp(glm::vec3(2 * heat - 0.6f, 1.4f - 2.4f * std::abs(heat - 0.5f), 1.2f - 2 * heat), 0.1f,
                               1.0f)});
        }
        EXPECT_GT(dynamic, 50) << averaging;
        EXPECT_GT(several, 50) << averaging;
        expect(std::string("flags, ") + averaging, kinds, shown);
        expect(std::string("collisions, ") + averaging, collisions, render("collisions"));
    }
}
