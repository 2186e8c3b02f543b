// Layers against the CPU: which layer each texel of the reflective shadow maps goes to, and what is stored of it.
#include "lrsm/layers_oracle.h"

#include <fmt/format.h>

using namespace bounce;

namespace {

using Sets = std::vector<std::pair<std::string, std::string>>;

struct Cut {
    const char* name;
    int depth_layers, normal_layers;
    bool adaptive;
    const char* overlap;
};

class Layers : public SceneGraphTest {
  protected:
    std::filesystem::path graph() {
        return graph_file(R"("passes":[{"type":"rsm","params":{"resolution":64}},{"type":"lrsm_layers"}])");
    }
    Sets sets(const Cut& cut) {
        return {{"lrsm_layers.depth_layers", std::to_string(cut.depth_layers)},
                {"lrsm_layers.normal_layers", std::to_string(cut.normal_layers)},
                {"lrsm_layers.adaptive", cut.adaptive ? "true" : "false"},
                {"lrsm_layers.overlap", cut.overlap}};
    }
};
class CutInParts : public Layers, public testing::WithParamInterface<Cut> {};

} // namespace

TEST_P(CutInParts, EveryTexelGoesToItsLayers) {
    const Cut& cut = GetParam();
    SceneRunner run(blocks(), one_of_each(), graph(), sets(cut));
    run.frame();
    LayersOracle oracle(run, cut.depth_layers, cut.normal_layers);
    LayerTextures stored(run);
    std::vector<int> table = run.read_buffer<int>("lrsm.table");
    ASSERT_EQ(oracle.maps.size, glm::ivec3(64, 64, 8));
    ASSERT_EQ(stored.size, glm::ivec3(32, 32, 8 * cut.depth_layers * cut.normal_layers)) << "a quarter of the texels";

    int blocks_compared = 0, borderline = 0, in_two = 0;
    double worst = 0;
    oracle.each_layer([&](int view, int d, int k) {
        int place = table[LayersOracle::table_index(view, d, k)];
        ASSERT_GE(place, 0);
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                bool unsure = false;
                for (int i = 0; i < 4; ++i)
                    unsure = unsure || oracle.borderline(view, 2 * x + (i & 1), 2 * y + (i >> 1));
                if (unsure) {
                    ++borderline;
                    continue;
                }
                LayerTexel expected = oracle.block(view, x, y, d, k), got = stored.at(place, x, y);
                blocks_compared += expected.normal.a > 0;
                EXPECT_EQ(got.normal.a, expected.normal.a) << "opacity is the share of texels: " << x << ", " << y;
                worst = std::max(worst, rounding_error(got, expected));
                if (d > 0)
                    for (int i = 0; i < 4; ++i)
                        in_two += oracle.belongs(view, 2 * x + (i & 1), 2 * y + (i >> 1), d, k) &&
                                  oracle.belongs(view, 2 * x + (i & 1), 2 * y + (i >> 1), d - 1, k);
            }
        }
    });
    fmt::print("    {}: {} blocks, {} borderline, {} texels in two layers, worst {:.2f} of the formats' rounding\n",
               cut.name, blocks_compared, borderline, in_two, worst);
    EXPECT_LT(worst, 1);
    EXPECT_GT(blocks_compared, 2000);
    EXPECT_LT(borderline, blocks_compared / 50);
    if (std::string(cut.overlap) != "0" && cut.depth_layers > 2) {
        EXPECT_GT(in_two, 10) << "nothing tests the overlap";
    }
}

/// Without overlap every texel with a surface is in exactly one layer.
TEST_P(CutInParts, OpacitiesSumToTheShareOfTexelsWithASurface) {
    Cut cut = GetParam();
    cut.overlap = "0";
    SceneRunner run(blocks(), one_of_each(), graph(), sets(cut));
    run.frame();
    LayersOracle oracle(run, cut.depth_layers, cut.normal_layers);
    LayerTextures stored(run);
    std::vector<int> table = run.read_buffer<int>("lrsm.table");
    int partly = 0;
    for (int view = 0; view < 8; ++view) {
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                double held = 0, sum = 0;
                bool unsure = false;
                for (int i = 0; i < 4; ++i) {
                    held += 0.25 * oracle.maps.holds(view, 2 * x + (i & 1), 2 * y + (i >> 1));
                    unsure = unsure || oracle.borderline(view, 2 * x + (i & 1), 2 * y + (i >> 1));
                }
                for (int d = 0; d < cut.depth_layers; ++d)
                    for (int k = 0; k < cut.normal_layers; ++k)
                        sum += stored.at(table[LayersOracle::table_index(view, d, k)], x, y).normal.a;
                if (unsure)
                    EXPECT_GE(sum, held) << view << ": " << x << ", " << y;
                else
                    EXPECT_EQ(sum, held) << view << ": " << x << ", " << y;
                partly += held > 0 && held < 1;
            }
        }
    }
    EXPECT_GT(partly, 10);
}

INSTANTIATE_TEST_SUITE_P(Cuts, CutInParts,
                         testing::Values(Cut{"one_layer", 1, 1, false, "0.05"}, Cut{"2x2", 2, 2, false, "0.05"},
                                         Cut{"4x1_wide_overlap", 4, 1, false, "0.5"}, Cut{"8x4", 8, 4, false, "0.1"},
                                         Cut{"adaptive_4x2", 4, 2, true, "0.2"}),
                         [](auto& test) {
                             std::string name = test.param.name;
                             return name;
                         });

/// Static boundaries cut the scene's extent along the view, and ⟨n·l⟩, into equal parts.
TEST_F(Layers, StaticBoundariesAreEquallySpaced) {
    SceneRunner run(blocks(), one_of_each(), graph(), sets({"", 5, 3, false, "0.1"}));
    run.frame();
    LayersOracle oracle(run, 5, 3);
    for (int view = 0; view < 8; ++view) {
        const LrsmPartition& p = oracle.partitions[size_t(view)];
        glm::dvec2 extent = extent_along(oracle.maps.views[size_t(view)], run.facts.bounds_over_animation);
        EXPECT_EQ(p.depth_layers, 5);
        for (int i = 0; i <= 5; ++i)
            EXPECT_NEAR(p.depth[i], extent.x + (extent.y - extent.x) * i / 5, 1e-5 * (1 + extent.y));
        for (int i = 0; i <= 3; ++i)
            EXPECT_NEAR(p.normal[i], i / 3.0, 1e-6);
        EXPECT_NEAR(p.overlap, 0.1 * (extent.y - extent.x) / 5, 1e-5 * (1 + extent.y));
    }
}

/// Two separate depths are cut apart, in the gap between them; one depth is not cut at all.
TEST_F(Layers, AdaptiveBoundariesLieBetweenSurfaces) {
    auto table_over_floor = [](bool table) {
        MadeScene made;
        made.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        if (table) made.quad({-1, 1.5f, 1}, {1, 1.5f, 1}, {1, 1.5f, -1}, {-1, 1.5f, -1});
        made.triangle({-2, 3, -2}, {-2, 3, -1.99f}, {-2, 3, -2}); // no area: only stretches the bounds
        return made.scene;
    };
    std::vector<Light> sun{directional_light({0, -1, 0}, {1, 1, 1})};
    SceneRunner two(table_over_floor(true), sun, graph(), sets({"", 4, 1, true, "0.05"}));
    two.frame();
    LrsmPartition p = two.read_buffer<LrsmPartition>("lrsm.partitions").at(0);
    ASSERT_EQ(p.depth_layers, 2);
    double top = extent_along(two.read_buffer<ShadowView>("rsm.views").at(0), two.facts.bounds_over_animation).x;
    EXPECT_GT(p.depth[1] - 0.5 * p.overlap, top + 1.5) << "below the table, which lies 1.5 m under the scene's top";
    EXPECT_LT(p.depth[1] + 0.5 * p.overlap, top + 3) << "above the floor";
    EXPECT_EQ(two.read_buffer<int>("lrsm.summary").at(2), 2) << "the number that was picked is shown";

    SceneRunner one(table_over_floor(false), sun, graph(), sets({"", 4, 1, true, "0.05"}));
    one.frame();
    EXPECT_EQ(one.read_buffer<LrsmPartition>("lrsm.partitions").at(0).depth_layers, 1);
}

/// Adaptive boundaries of ⟨n·l⟩ halve the texels, to the width of a bin of the histogram.
TEST_F(Layers, AdaptiveCosinesHoldEqualShares) {
    SceneRunner run(blocks(), one_of_each(), graph(), sets({"", 1, 2, true, "0"}));
    run.frame();
    LayersOracle oracle(run, 1, 2);
    for (int view = 0; view < 8; ++view) {
        double boundary = oracle.partitions[size_t(view)].normal[1];
        int below = 0, before = 0, all = 0; // below the boundary, and below it by more than a bin
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                if (!oracle.maps.holds(view, x, y)) continue;
                double cosine = oracle.maps.radiance_at(view, x, y).a;
                ++all;
                below += cosine < boundary || boundary == 1;
                before += cosine < boundary - 1.0 / 64;
            }
        }
        if (all == 0) continue;
        EXPECT_GE(2 * below, all) << view;
        EXPECT_LT(2 * before, all) << view;
    }
}
