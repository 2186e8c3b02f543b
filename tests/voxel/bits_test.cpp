// One bit a voxel holds what one byte a voxel holds, and its first mip is theirs.
#include "support/scene_runner.h"

using namespace bounce;

namespace {

const char* const k_graph =
    R"("passes":[{"type":"occlusion_voxels","params":{"route":"compute","resolution":32}},
      {"id":"voxel_mips","type":"compute","shader":"voxel/occlusion_mips.comp",
       "bind":{"voxels.finer":{"resource":"voxels.occlusion","mip":"iteration - 1"},
               "voxels.coarser":{"resource":"voxels.occlusion","mip":"iteration"}},
       "repeat":{"over":"mips","of":"voxels.occlusion","from":1}}])";
using Sets = std::vector<std::pair<std::string, std::string>>;

Scene slanted() {
    MadeScene made;
    made.box({-0.92f, -0.83f, -0.71f}, {-0.31f, -0.42f, -0.13f})
        .quad({-0.7f, 0.11f, 0.63f}, {0.83f, 0.37f, 0.91f}, {0.97f, 0.52f, -0.57f}, {-0.63f, 0.29f, -0.81f})
        .triangle({-0.97f, 0.93f, -0.95f}, {0.91f, -0.89f, 0.97f}, {0.9f, -0.9f, 0.985f});
    return made.scene;
}

class VoxelBits : public SceneGraphTest, public testing::WithParamInterface<bool> {};

} // namespace

TEST_P(VoxelBits, EqualBytes) {
    bool leaves = GetParam();
    Scene scene = slanted();
    Sets sets{{"occlusion_voxels.directional_leaves", leaves ? "true" : "false"},
              {"voxel_mips.mip_rule", leaves ? "along_leaf" : "mean"}};
    SceneRunner bytes(scene, {}, graph_file(k_graph), sets);
    bytes.frame();
    sets.emplace_back("occlusion_voxels.storage", "bits");
    sets.emplace_back("occlusion_voxels.mip_rule", leaves ? "along_leaf" : "mean");
    SceneRunner bits(scene, {}, graph_file(k_graph), sets);
    bits.frame();
    bits.frame(); // the second frame starts from the first one's bricks, cleared

    std::vector<float> voxels = bytes.read("voxels.occlusion");
    std::vector<uint32_t> bricks = bits.graph.texture("voxels.bricks")->read_integers();
    ASSERT_EQ(voxels.size(), 8 * bricks.size());
    constexpr int n = 32;
    int occupied = 0, wrong = 0;
    for (int z = 0; z < n * (leaves ? 6 : 1); ++z) {
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                bool byte = voxels[size_t((z * n + y) * n + x)] > 0;
                uint32_t brick = bricks[size_t(((z / 2) * n / 2 + y / 2) * n / 2 + x / 2)];
                bool bit = brick >> (x % 2 + 2 * (y % 2) + 4 * (z % 2)) & 1;
                occupied += byte;
                wrong += byte != bit;
            }
        }
    }
    EXPECT_GT(occupied, 500);
    EXPECT_EQ(wrong, 0);
    // Mips of eight bits: the first is rounded once on both ways, so all are the same.
    for (int mip = 0; mip < 5; ++mip)
        EXPECT_EQ(bits.read("voxels.occlusion", mip), bytes.read("voxels.occlusion", mip + 1)) << "mip " << mip;
}
INSTANTIATE_TEST_SUITE_P(Leaves, VoxelBits, testing::Bool());

TEST_F(SceneGraphTest, VoxelBitsNeedTheComputeRoute) {
    Scene scene = slanted();
    EXPECT_THROW(
        {
            SceneRunner run(scene, {}, graph_file(k_graph),
                            {{"occlusion_voxels.route", "raster"}, {"occlusion_voxels.storage", "bits"}});
            run.frame();
        },
        Error);
}
