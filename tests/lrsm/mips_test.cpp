// Every mip of the layers' radiance, normal and depth moments against means on the CPU.
#include "lrsm/layers_oracle.h"

#include <fmt/format.h>
#include <memory>

using namespace bounce;

namespace {

class LayerMips : public SceneGraphTest {
  protected:
    std::unique_ptr<SceneRunner> render() {
        auto run = std::make_unique<SceneRunner>(
            blocks(), one_of_each(),
            graph_file(
                fmt::format(R"("passes":[{{"type":"rsm","params":{{"resolution":64}}}},{{"type":"lrsm_layers"}},{}])",
                            k_mips_pass)),
            std::vector<std::pair<std::string, std::string>>{{"lrsm_layers.depth_layers", "3"},
                                                             {"lrsm_layers.normal_layers", "2"}});
        run->frame();
        return run;
    }
};

LayerTexel mean_of_four(const LayerTextures& finer, int place, int x, int y) {
    LayerTexel mean;
    for (int i = 0; i < 4; ++i) {
        LayerTexel one = finer.at(place, 2 * x + (i & 1), 2 * y + (i >> 1));
        mean.radiance += 0.25 * one.radiance;
        mean.normal += 0.25 * one.normal;
        mean.depth += 0.25 * one.depth;
    }
    return mean;
}

} // namespace

TEST_F(LayerMips, EachIsTheMeanOfTheOneBelow) {
    auto run = render();
    std::vector<LayerTextures> mips;
    for (int mip = 0; mip < run->texture("lrsm.radiance").desc().mips; ++mip)
        mips.emplace_back(*run, mip);
    ASSERT_EQ(mips.size(), 6u);
    EXPECT_EQ(mips.back().size, glm::ivec3(1, 1, 48));
    for (size_t mip = 1; mip < mips.size(); ++mip) {
        double worst = 0, opacity = 0;
        for (int place = 0; place < mips[mip].size.z; ++place)
            for (int y = 0; y < mips[mip].size.y; ++y)
                for (int x = 0; x < mips[mip].size.x; ++x) {
                    LayerTexel got = mips[mip].at(place, x, y);
                    worst = std::max(worst, rounding_error(got, mean_of_four(mips[mip - 1], place, x, y)));
                    opacity += got.normal.a;
                }
        EXPECT_LT(worst, 1) << "mip " << mip << ", in units of the formats' rounding";
        EXPECT_GT(opacity, 0) << "mip " << mip;
    }
}

/// The top of the chain is the mean of the reflective shadow map's own texels: the rounding of six levels at most.
TEST_F(LayerMips, TheCoarsestHoldsTheMomentsOfTheWholeMap) {
    auto run = render();
    LayersOracle oracle(*run, 3, 2);
    LayerTextures top(*run, 5);
    std::vector<int> table = run->read_buffer<int>("lrsm.table");
    int held = 0;
    double worst = 0;
    oracle.each_layer([&](int view, int d, int k) {
        LayerTexel mean;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                LayerTexel block = oracle.block(view, x, y, d, k);
                mean.radiance += block.radiance / 1024.0;
                mean.normal += block.normal / 1024.0;
                mean.depth += block.depth / 1024.0;
            }
        }
        LayerTexel got = top.at(table[LayersOracle::table_index(view, d, k)], 0, 0);
        held += mean.normal.a > 0;
        worst = std::max(worst, rounding_error(got, mean));
        if (mean.depth.b < 0.01) return; // too few texels for a variance out of 16 bits
        // μ and σ² as sampling recovers them, normalised by opacity.
        double mu = mean.depth.r / mean.depth.b, got_mu = got.depth.r / got.depth.b;
        EXPECT_NEAR(got_mu, mu, 3e-3);
        EXPECT_NEAR(got.depth.g / got.depth.b - got_mu * got_mu, mean.depth.g / mean.depth.b - mu * mu, 6e-3);
    });
    EXPECT_GT(held, 8);
    EXPECT_LT(worst, 6 + 1) << "in units of the formats' rounding";
}
