// Occlusion voxels against exact triangle–box overlap: the compute route and the raster route's exact fill equal it;
// the published fill, one voxel a column, stays inside it.
#include "support/made_scenes.h"
#include "voxel/overlap_oracle.h"

#include <fmt/format.h>

using namespace bounce;

namespace {

const char* const k_graph = R"("passes":[{"type":"occlusion_voxels"}])";
using Sets = std::vector<std::pair<std::string, std::string>>;

/// Slanted quads along every dominant axis, a turned-over one, a sliver, a triangle smaller than a voxel, a box.
Scene slanted() {
    MadeScene made;
    made.box({-0.92f, -0.83f, -0.71f}, {-0.31f, -0.42f, -0.13f})
        .quad({-0.7f, 0.11f, 0.63f}, {0.83f, 0.37f, 0.91f}, {0.97f, 0.52f, -0.57f}, {-0.63f, 0.29f, -0.81f})
        .quad({0.13f, -0.9f, -0.41f}, {0.31f, -0.87f, 0.77f}, {0.42f, 0.03f, 0.69f}, {0.19f, -0.09f, -0.53f})
        .quad({-0.93f, -0.61f, 0.31f}, {-0.17f, -0.73f, 0.57f}, {-0.11f, 0.07f, 0.43f}, {-0.87f, 0.21f, 0.23f})
        .triangle({-0.97f, 0.93f, -0.95f}, {0.91f, -0.89f, 0.97f}, {0.9f, -0.9f, 0.985f})
        .triangle({0.71f, -0.731f, -0.72f}, {0.723f, -0.725f, -0.716f}, {0.718f, -0.711f, -0.713f});
    made.material().double_sided = true;
    for (Vertex& vertex : made.scene.vertices) // authored the other way round than it is wound
        if (vertex.position.z == 0.31f || vertex.position.z == 0.57f || vertex.position.z == 0.43f ||
            vertex.position.z == 0.23f)
            vertex.normal = -vertex.normal;
    return made.scene;
}
Scene cornell() {
    return load_gltf(find_scene("cornell.gltf", "."));
}

class OcclusionVoxels : public SceneGraphTest {
  protected:
    std::vector<float> voxels(const Scene& scene, int resolution, Sets sets) {
        sets.emplace_back("occlusion_voxels.resolution", std::to_string(resolution));
        SceneRunner run(scene, {}, graph_file(k_graph), sets);
        run.frame();
        return run.read("voxels.occlusion");
    }
    void note(const std::string& what, const OverlapCount& count) {
        fmt::print("    {:<34} {:>6} occupied, {} borderline, {} missing ({:.2f} %), {} extra\n", what, count.occupied,
                   count.borderline, count.missing, 100 * count.missing_share(), count.extra);
    }
    void expect_exact(const std::string& what, const OverlapCount& count) {
        note(what, count);
        EXPECT_GT(count.occupied, 100) << what;
        EXPECT_EQ(count.missing, 0) << what;
        EXPECT_EQ(count.extra, 0) << what;
        EXPECT_EQ(count.between, 0) << what;
        EXPECT_LT(count.borderline, 0.01 * count.occupied) << what;
    }
};

struct Case {
    const char* name;
    Scene (*scene)();
    int resolution;
};
class OfAScene : public OcclusionVoxels, public testing::WithParamInterface<Case> {};

} // namespace

TEST_P(OfAScene, ByComputeAreExact) {
    Scene scene = GetParam().scene();
    OverlapOracle oracle(scene, GetParam().resolution);
    expect_exact("compute",
                 count_overlap(oracle, voxels(scene, GetParam().resolution, {{"occlusion_voxels.route", "compute"}})));
}

TEST_P(OfAScene, ByRasterWithExactFillAreExact) {
    Scene scene = GetParam().scene();
    OverlapOracle oracle(scene, GetParam().resolution);
    expect_exact("raster, exact", count_overlap(oracle, voxels(scene, GetParam().resolution,
                                                               {{"occlusion_voxels.route", "raster"},
                                                                {"occlusion_voxels.fill", "exact"}})));
}

/// Thinner than the triangles, but nothing beside them: and no surface vanishes.
TEST_P(OfAScene, ByRasterAsPublishedLieInsideTheExactOnes) {
    Scene scene = GetParam().scene();
    OverlapOracle oracle(scene, GetParam().resolution);
    OverlapCount count =
        count_overlap(oracle, voxels(scene, GetParam().resolution,
                                     {{"occlusion_voxels.route", "raster"}, {"occlusion_voxels.fill", "centre"}}));
    note("raster, centre", count);
    RecordProperty("missing_share", fmt::format("{:.4f}", count.missing_share()));
    EXPECT_EQ(count.extra, 0);
    EXPECT_EQ(count.between, 0);
    EXPECT_GT(count.missing, 0) << "one voxel a column cannot be all";
    // A plane along the diagonal (1, 1, 1) overlaps three voxels a column, of which one is marked.
    EXPECT_LT(count.missing_share(), 0.7);
}

TEST_P(OfAScene, InDirectionalLeavesAreExactInEachLeaf) {
    constexpr double k_threshold = 0.3;
    Scene scene = GetParam().scene();
    int resolution = GetParam().resolution;
    OverlapOracle oracle(scene, resolution, k_threshold);
    for (const Sets& route : {Sets{{"occlusion_voxels.route", "compute"}},
                              Sets{{"occlusion_voxels.route", "raster"}, {"occlusion_voxels.fill", "exact"}}}) {
        Sets sets = route;
        sets.emplace_back("occlusion_voxels.directional_leaves", "true");
        sets.emplace_back("occlusion_voxels.leaf_threshold", fmt::format("{}", k_threshold));
        std::vector<float> got = voxels(scene, resolution, sets);
        ASSERT_EQ(got.size(), oracle.separations.size());
        expect_exact(route[0].second + ", six leaves", count_overlap(oracle, got));
        size_t volume = got.size() / 6;
        for (size_t leaf = 0; leaf < 6; ++leaf)
            EXPECT_GT(std::count(got.begin() + long(leaf * volume), got.begin() + long((leaf + 1) * volume), 1.0f), 10)
                << "leaf " << leaf;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, OfAScene,
                         testing::Values(Case{"slanted_32", slanted, 32}, Case{"slanted_64", slanted, 64},
                                         Case{"cornell_32", cornell, 32}, Case{"cornell_64", cornell, 64}),
                         [](auto& test) { return std::string(test.param.name); });

/// A steeper threshold empties the leaves that a slope only just reaches.
TEST_F(OcclusionVoxels, LeavesFollowTheThreshold) {
    MadeScene made;
    made.quad({-1, -1, 0}, {1, -1, 0}, {1, 0.5f, 1}, {-1, 0.5f, 1}); // facing (0, −.55, .83)
    for (auto [threshold, leaves] : {std::pair{"0.5", 2}, {"0.6", 1}, {"0.9", 0}}) {
        std::vector<float> got = voxels(made.scene, 32,
                                        {{"occlusion_voxels.route", "compute"},
                                         {"occlusion_voxels.directional_leaves", "true"},
                                         {"occlusion_voxels.leaf_threshold", threshold}});
        size_t volume = got.size() / 6;
        int filled = 0;
        for (size_t leaf = 0; leaf < 6; ++leaf)
            filled += std::count(got.begin() + long(leaf * volume), got.begin() + long((leaf + 1) * volume), 1.0f) > 0;
        EXPECT_EQ(filled, leaves) << threshold;
        EXPECT_GT(std::count(got.begin() + long(3 * volume), got.begin() + long(4 * volume), 1.0f),
                  std::string(threshold) == "0.5" ? 0 : -1)
            << "−y";
    }
}

TEST_F(OcclusionVoxels, TransparentPartsOfAlphaTestedMaterialsAreEmpty) {
    for (bool by_texture : {false, true}) {
        Scene scene = half_transparent(by_texture);
        OverlapOracle oracle(scene, 32);
        double middle = -oracle.origin.x * 32 / oracle.side; // x = 0 in voxels
        // Alpha is looked up at one point a voxel; the rim between the parts is blurred by the texture's filter.
        double rim = by_texture ? 3 : 1;
        for (const Sets& route : {Sets{{"occlusion_voxels.route", "compute"}},
                                  Sets{{"occlusion_voxels.route", "raster"}, {"occlusion_voxels.fill", "exact"}},
                                  Sets{{"occlusion_voxels.route", "raster"}, {"occlusion_voxels.fill", "centre"}}}) {
            std::string what = fmt::format("{} {}, alpha by {}", route[0].second,
                                           route.size() > 1 ? route[1].second : "", by_texture ? "texture" : "colour");
            std::vector<float> got = voxels(scene, 32, route);
            OverlapCount left = count_overlap(oracle, got, [&](glm::ivec3 v) { return v.x + 0.5 < middle - rim; });
            EXPECT_GT(left.occupied, 200);
            EXPECT_EQ(left.missing, left.occupied) << what << ": transparent";
            EXPECT_EQ(left.extra, 0) << what;
            OverlapCount right = count_overlap(oracle, got, [&](glm::ivec3 v) { return v.x + 0.5 > middle + rim; });
            if (route.size() > 1 && route[1].second == "centre") {
                EXPECT_EQ(right.extra, 0) << what;
                EXPECT_LT(right.missing_share(), 0.7) << what;
            } else {
                expect_exact(what, right);
            }
        }
    }
}

/// Stripes that voxels resolve stay stripes, however many texels the texture has: neither blurred nor skipped.
TEST_F(OcclusionVoxels, StripesOfAlphaSurviveWhateverTheTexturesSize) {
    for (int texels : {32, 64, 512}) {
        Scene scene = half_transparent(true);
        Image8& image = scene.textures[0].image;
        image = {texels, texels, std::vector<uint8_t>(size_t(texels * texels) * 4, 255)};
        for (size_t i = 0; i < size_t(texels * texels); ++i)
            image.rgba[4 * i + 3] = (int(i) % texels) * 8 / texels % 2 ? 255 : 0;
        OverlapOracle oracle(scene, 32);
        double left = (-1 - oracle.origin.x) * 32 / oracle.side,
               width = 2 * 32 / oracle.side / 8; // 3.8 voxels a stripe
        for (const char* route : {"compute", "raster"}) {
            std::vector<float> got =
                voxels(scene, 32, {{"occlusion_voxels.route", route}, {"occlusion_voxels.fill", "exact"}});
            for (bool opaque : {false, true}) {
                OverlapCount count = count_overlap(oracle, got, [&](glm::ivec3 v) {
                    double stripe = (v.x + 0.5 - left) / width, within = stripe - std::floor(stripe);
                    return (int(std::floor(stripe)) % 2 == 1) == opaque && std::abs(within - 0.5) < 0.2;
                });
                EXPECT_GT(count.occupied, 50);
                EXPECT_EQ(count.missing, opaque ? 0 : count.occupied) << route << ", " << texels << " texels";
            }
        }
    }
}
