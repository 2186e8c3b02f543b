// Blended surfaces in occlusion voxels: right in the mean, whatever the tessellation, and alike on both routes.
#include "support/made_scenes.h"

#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 64;

/// A level sheet of n × n quads across a box of two small triangles that hold the grid's size.
Scene sheet(int n, float alpha, AlphaMode mode) {
    MadeScene made;
    made.triangle({-1, -1, -1}, {-0.999f, -1, -1}, {-1, -1, -0.999f})
        .triangle({1, 1, 1}, {0.999f, 1, 1}, {1, 1, 0.999f});
    Primitive whole;
    whole.first_index = uint32_t(made.scene.indices.size());
    for (int i = 0; i < n * n; ++i) {
        const float x = -0.9f + 1.8f * float(i % n) / float(n), z = -0.9f + 1.8f * float(i / n) / float(n),
                    s = 1.8f / float(n);
        made.quad({x, 0.013f, z + s}, {x + s, 0.013f, z + s}, {x + s, 0.013f, z}, {x, 0.013f, z});
        made.scene.meshes[0].primitives.pop_back();
    }
    whole.index_count = uint32_t(made.scene.indices.size()) - whole.first_index;
    whole.material = int(made.scene.materials.size()) - 1;
    made.scene.meshes[0].primitives.push_back(whole); // one draw
    made.material().base_colour.a = alpha;
    made.material().alpha_mode = mode;
    return made.scene;
}

class VoxelCoverage : public SceneGraphTest {
  protected:
    std::vector<float> voxels(const Scene& scene, const char* route, const char* fill = "exact") {
        SceneRunner run(scene, {}, graph_file(R"("passes":[{"type":"occlusion_voxels"}])"),
                        {{"occlusion_voxels.resolution", std::to_string(k_resolution)},
                         {"occlusion_voxels.route", route},
                         {"occlusion_voxels.fill", fill}});
        run.frame();
        return run.read("voxels.occlusion");
    }
    static double occupied(const std::vector<float>& voxels) {
        double sum = 0;
        for (float value : voxels)
            sum += value > 0.5f;
        return sum;
    }
};

} // namespace

TEST_F(VoxelCoverage, IsRightInTheMean) {
    for (int n : {1, 40}) {
        const double all = occupied(voxels(sheet(n, 1, AlphaMode::opaque), "compute"));
        for (float alpha : {0.2f, 0.7f}) {
            const double share = occupied(voxels(sheet(n, alpha, AlphaMode::blend), "compute")) / all;
            fmt::print("    {} quads, alpha {}: {:.3f} of the voxels\n", n * n, alpha, share);
            EXPECT_NEAR(share, double(alpha), 4 * std::sqrt(double(alpha * (1 - alpha)) / all));
        }
    }
}

TEST_F(VoxelCoverage, AlphaOneIsOpaqueAndZeroIsNotThere) {
    for (const char* route : {"compute", "raster"}) {
        EXPECT_EQ(voxels(sheet(3, 1, AlphaMode::blend), route), voxels(sheet(3, 1, AlphaMode::opaque), route));
        EXPECT_LT(occupied(voxels(sheet(3, 0, AlphaMode::blend), route)), 20); // the two corners of the grid
    }
}

TEST_F(VoxelCoverage, BothRoutesDrawAlike) {
    EXPECT_EQ(voxels(sheet(3, 0.4f, AlphaMode::blend), "compute"), voxels(sheet(3, 0.4f, AlphaMode::blend), "raster"));
}
