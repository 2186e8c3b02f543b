// Curtains thinner than a voxel, whose averaged normals are not those of any of their surfaces: the light that their
// voxels send, under Eq. 2, under Eq. 3-5, and with both sides lit, against what the surfaces send.
#include "support/scene_runner.h"
#include "voxel/voxel_grid.h"

#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 32;
constexpr double k_voxel = 2.0 / (k_resolution - 2); // the longest edge is 2 m
const char* const k_graph =
    R"("passes":[{"type":"voxelization","params":{"resolution":32,"averaging":"sum","route":"compute"}},
        {"type":"voxel_direct","params":{"occlusion":"none"}}])";

/// Two far corners fix the grid: its voxels begin at multiples of k_voxel.
MadeScene corners() {
    MadeScene made;
    float e = 1e-3f;
    made.triangle({-1, -1, -1}, {-1 + e, -1, -1}, {-1, -1 + e, -1}).triangle({1, 1, 1}, {1 - e, 1, 1}, {1, 1 - e, 1});
    return made;
}

class Curtain : public SceneGraphTest {
  protected:
    /// Mean red radiance of the curtain's voxels, on the side that faces `side` (±1 along x); without a back volume the
    /// one value that there is.
    double sent(const Scene& scene, glm::vec3 toward_light, int side,
                const std::vector<std::pair<std::string, std::string>>& sets) {
        SceneRunner run(scene, {directional_light(-toward_light, glm::vec3(10))}, graph_file(k_graph), sets);
        run.frame();
        std::vector<float> radiance = run.read("dvs.radiance"), albedo = run.read("voxels.albedo"),
                           normal = run.read("voxels.normal");
        bool two = run.texture("dvs.radiance").desc().size.z > k_resolution;
        size_t behind = size_t(k_resolution) * k_resolution * k_resolution;
        double sum = 0;
        int count = 0;
        for (int z = 8; z < 24; ++z)
            for (int y = 8; y < 24; ++y)
                for (int x = 8; x < 24; ++x) {
                    size_t i = size_t(x + k_resolution * (y + k_resolution * z));
                    if (albedo[4 * i + 3] == 0) continue;
                    // Where normals cancel, the front faces the first axis that a surface faces: +x.
                    bool front = std::abs(normal[4 * i]) < 0.05f ? side > 0 : normal[4 * i] * float(side) > 0;
                    sum += radiance[4 * (i + (two && !front ? behind : 0))];
                    ++count;
                }
        EXPECT_GT(count, 100);
        return sum / count;
    }
};

} // namespace

/// Two sheets in one layer of voxels: N = 0, or a third of a normal where three triangles meet in a voxel. Each voxel
/// has one side only: whatever the light, half of what the two sides send together is lost.
TEST_F(Curtain, OfTwoSheetsLosesOneOfItsSides) {
    float x = float(0.5 * k_voxel), g = float(0.1 * k_voxel), e = 0.8f;
    Scene scene = corners()
                      .quad({x + g, -e, e}, {x + g, -e, -e}, {x + g, e, -e}, {x + g, e, e}, glm::vec3(0.6f))
                      .quad({x - g, -e, -e}, {x - g, -e, e}, {x - g, e, e}, {x - g, e, -e}, glm::vec3(0.6f))
                      .scene;
    double exact = 10 * 0.6 / M_PI * std::sqrt(0.5), lambert_of_both = 0, weighted_of_both = 0;
    for (int side : {1, -1}) {
        glm::vec3 l(glm::normalize(glm::vec3(side, 1, 0)));
        double lambert = sent(scene, l, side, {}) / exact;
        double weighted = sent(scene, l, side, {{"voxel_direct.attenuation", "normal_weighted"}}) / exact;
        double both = sent(scene, l, side, {{"voxel_direct.two_sided", "true"}}) / exact;
        fmt::print("    two sheets lit from {}x: Eq. 2 {:.3f}, Eq. 3-5 {:.3f}, both sides {:.3f} of what they send\n",
                   side > 0 ? '+' : '-', lambert, weighted, both);
        EXPECT_NEAR(both, 1, 0.01);
        lambert_of_both += 0.5 * lambert, weighted_of_both += 0.5 * weighted;
    }
    EXPECT_NEAR(lambert_of_both, 0.5, 0.01);
    EXPECT_LT(weighted_of_both, 0.5);
}

/// Folds of half a voxel at 45°, lit along the curtain's normal: every facet has the cosine √½. Their averaged normal
/// is (√½, 0, 0). Eq. 2 takes its direction, whose cosine is 1; Eq. 3-5 take its square, ½.
TEST_F(Curtain, InFoldsIsTooBrightByEq2AndTooDarkByEq5) {
    MadeScene made = corners();
    float v = float(k_voxel), x = 0.25f * v, d = 0.5f * v, e = 0.8f;
    for (float z = -0.8f + 0.01f; z < 0.8f; z += 0.5f * v) // up, then down
        made.quad({x, -e, z + 0.5f * d}, {x + 0.5f * d, -e, z}, {x + 0.5f * d, e, z}, {x, e, z + 0.5f * d},
                  glm::vec3(0.6f))
            .quad({x + 0.5f * d, -e, z}, {x, -e, z - 0.5f * d}, {x, e, z - 0.5f * d}, {x + 0.5f * d, e, z},
                  glm::vec3(0.6f));
    double exact = 10 * 0.6 / M_PI * std::sqrt(0.5);
    double lambert = sent(made.scene, {1, 0, 0}, 1, {}) / exact;
    double weighted = sent(made.scene, {1, 0, 0}, 1, {{"voxel_direct.attenuation", "normal_weighted"}}) / exact;
    fmt::print("    folds: Eq. 2 {:.3f}, Eq. 3-5 {:.3f} of what they send\n", lambert, weighted);
    EXPECT_NEAR(lambert, std::sqrt(2.0), 0.05);
    EXPECT_NEAR(weighted, std::sqrt(0.5), 0.08);
}
