// Blended surfaces in the raster passes, by a hash of texel and triangle: right in the mean, opaque at alpha 1, not
// there at alpha 0, and independent from layer to layer.

#include "core/low_discrepancy.h"
#include "scene/coverage.h"
#include "scene/shot.h"
#include "support/scene_runner.h"

#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_side = 64;

/// A floor of base colour ½ under `layers` level sheets of base colour 0, all in one mesh.
Scene layered(int layers, float alpha, AlphaMode mode = AlphaMode::blend) {
    MadeScene made;
    made.quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9});
    for (int i = 0; i < layers; ++i) {
        const float y = 3 + 0.25f * float(i);
        made.quad({-9, y, 9}, {9, y, 9}, {9, y, -9}, {-9, y, -9}, glm::vec3(0));
        made.material().base_colour.a = alpha;
        made.material().alpha_mode = mode;
    }
    return made.scene;
}

class RasterCoverage : public SceneGraphTest {
  protected:
    static constexpr const char* k_graph =
        R"("resources":{"out.direct":{"format":"rgba32f"}},"passes":[{"type":"gbuffer"},{"type":"shadow_maps"},)"
        R"({"type":"rsm"},{"id":"direct","type":"compute","shader":"surface/direct.comp"}])";

    /// Looks down from `height`, lit by a sun straight above.
    std::unique_ptr<SceneRunner> runner(Scene scene, float height,
                                        std::vector<std::pair<std::string, std::string>> sets = {}) {
        sets.emplace_back("shadow_maps.resolution", "256");
        sets.emplace_back("rsm.resolution", "128");
        auto run = std::make_unique<SceneRunner>(std::move(scene),
                                                 std::vector<Light>{directional_light({0, -1, 0}, glm::vec3(2))},
                                                 graph_file(k_graph), sets, glm::ivec2(k_side));
        run->camera.position = {0, height, 0.001f};
        run->camera.target = {0, 0, 0};
        run->camera.vfov = 0.6f;
        run->frame();
        return run;
    }
    static double share(const std::vector<float>& texels, size_t channels, float least) {
        double sum = 0;
        for (size_t i = 0; i < texels.size(); i += channels)
            sum += texels[i] >= least;
        return sum / double(texels.size() / channels);
    }
    static double mean(const std::vector<float>& texels, size_t channels) {
        double sum = 0;
        for (size_t i = 0; i < texels.size(); i += channels)
            sum += double(texels[i]);
        return sum / double(texels.size() / channels);
    }
};

} // namespace

TEST(CoverageThreshold, IsEvenAndNeverZero) {
    EXPECT_GT(coverage_threshold(0), 0);
    EXPECT_LT(coverage_threshold(~0u), 1);
    double below = 0;
    for (uint32_t i = 0; i < 100000; ++i)
        below += coverage_threshold(hash_u32(i)) <= 0.3f;
    EXPECT_NEAR(below / 100000, 0.3, 0.006);
}

TEST_F(RasterCoverage, StacksLetThroughTheirPower) {
    for (float alpha : {0.25f, 0.6f}) {
        for (int layers : {1, 2, 3}) {
            const double through = std::pow(1.0 - double(alpha), layers);
            const double deviation = 4 * std::sqrt(through * (1 - through)) / k_side;
            const auto above = runner(layered(layers, alpha), 12);
            const double seen = share(above->read("gbuffer.albedo"), 4, 0.25f);
            EXPECT_NEAR(seen, through, deviation) << "G-buffer, " << layers << " layers of " << alpha;
            // What the light reaches through the same layers, by the shadow map: texels of .07 m, all seen from below.
            const auto below = runner(layered(layers, alpha), 2.5f);
            const double lit = mean(below->read("out.direct"), 4) * 3.14159265358979;
            EXPECT_NEAR(lit, through, 0.1) << "shadow map, " << layers << " layers of " << alpha;
            const double sent = share(below->read("rsm.radiance"), 4, 1e-3f);
            EXPECT_NEAR(sent, through, 4 * std::sqrt(through * (1 - through)) / 128 + 0.06)
                << "reflective shadow map, " << layers << " layers of " << alpha;
            fmt::print(
                "    {} layers of {}: {:.3f} let through; G-buffer {:.3f}, shadow map {:.3f}, reflective {:.3f}\n",
                layers, alpha, through, seen, lit, sent);
        }
    }
}

TEST_F(RasterCoverage, AlphaOneIsOpaqueAndZeroIsNotThere) {
    for (float height : {12.0f, 2.5f}) {
        const auto blend = runner(layered(2, 1), height), opaque = runner(layered(2, 1, AlphaMode::opaque), height);
        const auto clear = runner(layered(2, 0), height), masked = runner(layered(2, 0, AlphaMode::mask), height);
        for (const char* resource : {"gbuffer.albedo", "gbuffer.depth", "shadow.depth", "rsm.radiance", "out.direct"}) {
            EXPECT_EQ(blend->read(resource), opaque->read(resource)) << resource;
            EXPECT_EQ(clear->read(resource), masked->read(resource)) << resource;
        }
    }
}

TEST_F(RasterCoverage, CutoffsAtTheirEnds) {
    for (float cutoff : {0.0f, 1.0f, 1.5f}) {
        for (float alpha : {0.0f, 1.0f}) {
            Scene scene = layered(1, alpha, AlphaMode::mask);
            scene.materials.back().alpha_cutoff = cutoff;
            const double floor = share(runner(scene, 12)->read("gbuffer.albedo"), 4, 0.25f);
            EXPECT_EQ(floor, alpha >= cutoff ? 0 : 1) << "alpha " << alpha << ", cutoff " << cutoff;
        }
    }
}

TEST_F(RasterCoverage, AStillPictureStaysUnlessAsked) {
    for (bool by_frame : {false, true}) {
        const auto run = runner(layered(1, 0.5f), 12, {{"gbuffer.coverage_by_frame", by_frame ? "true" : "false"}});
        const std::vector<float> first = run->read("gbuffer.albedo");
        run->frame();
        EXPECT_EQ(run->read("gbuffer.albedo") == first, !by_frame);
    }
}
