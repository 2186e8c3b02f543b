// Mips of occlusion voxels, by both rules and on every level, against the CPU.
#include "support/scene_runner.h"

#include <algorithm>
#include <cmath>

using namespace bounce;

namespace {

/// One level as it lies in the texture.
struct Level {
    int size;
    std::vector<float> values;
    float at(int x, int y, int z) const {
        return values[(size_t(z) * size_t(size) + size_t(y)) * size_t(size) + size_t(x)];
    }
};

double mean_of_eight(const Level& finer, glm::ivec3 voxel) {
    double sum = 0;
    for (int i = 0; i < 8; ++i)
        sum += finer.at(2 * voxel.x + (i & 1), 2 * voxel.y + ((i >> 1) & 1), 2 * voxel.z + (i >> 2));
    return sum / 8;
}

/// Four columns of two voxels along the axis, composited front to back.
double mean_of_columns(const Level& finer, glm::ivec3 voxel, int axis) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        glm::ivec3 near = 2 * voxel;
        near[(axis + 1) % 3] += i & 1;
        near[(axis + 2) % 3] += i >> 1;
        glm::ivec3 far = near;
        ++far[axis];
        double open = (1.0 - finer.at(near.x, near.y, near.z)) * (1.0 - finer.at(far.x, far.y, far.z));
        sum += 1 - open;
    }
    return sum / 4;
}

class OcclusionMips : public SceneGraphTest {
  protected:
    std::vector<Level> levels(bool leaves, const std::string& rule) {
        MadeScene made;
        made.box({-0.9f, -0.8f, -0.7f}, {-0.3f, -0.4f, -0.1f})
            .quad({-0.7f, 0.1f, 0.6f}, {0.8f, 0.4f, 0.9f}, {1, 0.5f, -0.6f}, {-0.6f, 0.3f, -0.8f})
            .quad({0.1f, -0.9f, -0.4f}, {0.3f, -0.9f, 0.8f}, {0.4f, 0, 0.7f}, {0.2f, -0.1f, -0.5f});
        SceneRunner run(made.scene, {}, graph_file(R"("passes":[{"type":"occlusion_voxels"},
            {"id":"voxel_mips","type":"compute","shader":"voxel/occlusion_mips.comp",
             "bind":{"voxels.finer":{"resource":"voxels.occlusion","mip":"iteration - 1"},
                     "voxels.coarser":{"resource":"voxels.occlusion","mip":"iteration"}},
             "repeat":{"over":"mips","of":"voxels.occlusion","from":1}}])"),
                        {{"occlusion_voxels.resolution", "32"},
                         {"occlusion_voxels.route", "compute"},
                         {"occlusion_voxels.directional_leaves", leaves ? "true" : "false"},
                         {"voxel_mips.mip_rule", rule}});
        run.frame();
        std::vector<Level> all;
        for (int mip = 0; mip < run.texture("voxels.occlusion").desc().mips; ++mip)
            all.push_back({32 >> mip, run.read("voxels.occlusion", mip)});
        return all;
    }
    /// Each level against the one below it; half a step of 8 bits is the rounding.
    template <class Rule>
    void expect(const std::vector<Level>& all, Rule&& rule) {
        ASSERT_EQ(all.size(), 6u); // 32 … 1
        for (size_t mip = 1; mip < all.size(); ++mip) {
            const Level& coarser = all[mip];
            int slices = int(coarser.values.size()) / (coarser.size * coarser.size);
            EXPECT_EQ(slices % coarser.size, 0);
            double worst = 0;
            int partial = 0;
            for (int z = 0; z < slices; ++z)
                for (int y = 0; y < coarser.size; ++y)
                    for (int x = 0; x < coarser.size; ++x) {
                        double expected = rule(all[mip - 1], glm::ivec3(x, y, z), coarser.size);
                        worst = std::max(worst, std::abs(coarser.at(x, y, z) - expected));
                        partial += expected > 0 && expected < 1;
                    }
            EXPECT_LT(worst, 0.5 / 255 + 1e-6) << "mip " << mip;
            EXPECT_GT(partial, 0) << "mip " << mip << " holds nothing to be wrong about";
        }
    }
};

} // namespace

TEST_F(OcclusionMips, MeanIsTheShareOfOccupiedVoxels) {
    for (bool leaves : {false, true}) {
        std::vector<Level> all = levels(leaves, "mean");
        expect(all, [](const Level& finer, glm::ivec3 voxel, int) { return mean_of_eight(finer, voxel); });
        // The top is the share of the whole volume: rounding adds half a step a level at most.
        size_t volume = 32 * 32 * 32;
        for (size_t leaf = 0; leaf < (leaves ? 6u : 1u); ++leaf) {
            auto from = all[0].values.begin() + long(leaf * volume);
            double share = double(std::count(from, from + long(volume), 1.0f)) / double(volume);
            EXPECT_NEAR(all[5].values[leaf], share, 5 * 0.5 / 255) << "leaf " << leaf;
        }
    }
}

TEST_F(OcclusionMips, AlongLeafCompositesInDepthAndAveragesAcross) {
    std::vector<Level> all = levels(true, "along_leaf");
    expect(all, [](const Level& finer, glm::ivec3 voxel, int size) {
        return mean_of_columns(finer, voxel, voxel.z / size / 2);
    });
}

/// Without leaves there is no axis to composite along.
TEST_F(OcclusionMips, AlongLeafWithoutLeavesIsTheMean) {
    EXPECT_EQ(levels(false, "along_leaf")[2].values, levels(false, "mean")[2].values);
}
