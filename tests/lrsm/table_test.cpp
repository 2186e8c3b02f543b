// The table of stored layers: which layers have a place in the pool, which are empty, which found none.
#include "lrsm/layers_oracle.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

using namespace bounce;

namespace {

using Sets = std::vector<std::pair<std::string, std::string>>;

class LayerTable : public SceneGraphTest {
  protected:
    std::filesystem::path graph() {
        return graph_file(fmt::format(
            R"("passes":[{{"type":"rsm","params":{{"resolution":64}}}},{{"type":"lrsm_layers"}},{}])", k_mips_pass));
    }
};

const Sets k_skip_empty{
    {"lrsm_layers.depth_layers", "4"}, {"lrsm_layers.normal_layers", "2"}, {"lrsm_layers.skip_empty", "true"}};

} // namespace

TEST_F(LayerTable, HoldsEveryLayerOnceWhenNoneIsSkipped) {
    SceneRunner run(blocks(), one_of_each(), graph(),
                    {{"lrsm_layers.depth_layers", "3"}, {"lrsm_layers.normal_layers", "2"}});
    run.frame();
    std::vector<int> table = run.read_buffer<int>("lrsm.table"), summary = run.read_buffer<int>("lrsm.summary");
    ASSERT_EQ(table.size(), size_t(8 * k_max_depth_layers * k_max_normal_layers));
    std::set<int> places;
    for (size_t i = 0; i < table.size(); ++i) {
        bool wanted = int(i) / k_max_normal_layers % k_max_depth_layers < 3 && int(i) % k_max_normal_layers < 2;
        EXPECT_EQ(table[i] >= 0, wanted) << i;
        if (table[i] >= 0) {
            EXPECT_TRUE(places.insert(table[i]).second) << "place " << table[i] << " given twice";
        }
    }
    EXPECT_EQ(places.size(), 48u);
    EXPECT_EQ(*places.rbegin(), 47);
    EXPECT_EQ(summary[0], 48);
    EXPECT_EQ(summary[1], 0);
    EXPECT_EQ(summary[2], 3);
}

TEST_F(LayerTable, SkipsExactlyTheEmptyLayers) {
    SceneRunner run(blocks(), one_of_each(), graph(), k_skip_empty);
    run.frame();
    LayersOracle oracle(run, 4, 2);
    std::vector<int> table = run.read_buffer<int>("lrsm.table"), summary = run.read_buffer<int>("lrsm.summary");
    int full = 0, empty = 0;
    oracle.each_layer([&](int view, int d, int k) {
        bool held = oracle.texels_of(view, d, k) > 0;
        (held ? full : empty) += 1;
        EXPECT_EQ(table[LayersOracle::table_index(view, d, k)] >= 0, held) << view << ": " << d << ", " << k;
    });
    EXPECT_EQ(summary[0], full);
    EXPECT_EQ(summary[1], 0);
    EXPECT_GT(full, 4);
    EXPECT_GT(empty, 4);
    fmt::print("    {} layers stored of {}\n", full, full + empty);
}

/// Storage for fewer layers than hold something: the rest is counted, not written anywhere.
TEST_F(LayerTable, CountsLayersThatThePoolIsTooSmallFor) {
    SceneRunner whole(blocks(), one_of_each(), graph(), k_skip_empty);
    whole.frame();
    int full = whole.read_buffer<int>("lrsm.summary")[0];
    Sets sets = k_skip_empty;
    sets.emplace_back("lrsm_layers.pool", "3");
    SceneRunner run(blocks(), one_of_each(), graph(), sets);
    run.frame();
    std::vector<int> table = run.read_buffer<int>("lrsm.table"), summary = run.read_buffer<int>("lrsm.summary");
    EXPECT_EQ(run.texture("lrsm.radiance").desc().size.z, 3);
    EXPECT_EQ(summary[0], 3);
    EXPECT_EQ(summary[1], full - 3);
    EXPECT_EQ(std::count_if(table.begin(), table.end(), [](int place) { return place >= 0; }), 3);
    EXPECT_LT(*std::max_element(table.begin(), table.end()), 3);
    // The three that have a place are the same as with room for all.
    LayerTextures few(run), all(whole);
    for (size_t i = 0; i < few.radiance.size(); ++i)
        ASSERT_EQ(few.radiance[i], all.radiance[i]);
}

/// A floor at the very end of the scene, whose depth may round to beyond the last boundary: it is not lost.
TEST_F(LayerTable, StoresSurfacesAtTheScenesEnds) {
    for (float height : {0.0f, 0.1f, -0.7f, 3.3f, 10.7f, -123.4f}) {
        for (const Light& light : {directional_light({0, -1, 0}, {1, 1, 1}),
                                   spot_light({0, height + 1.3f, 0}, {0, -1, 0}, {1, 1, 1}, 30, 40)}) {
            MadeScene made;
            made.quad({-2, height, 2}, {2, height, 2}, {2, height, -2}, {-2, height, -2});
            made.quad({-2, height + 1, 2}, {-1.9f, height + 1, 2}, {-1.9f, height + 1, 1.9f}, {-2, height + 1, 1.9f});
            SceneRunner run(made.scene, {light}, graph(), k_skip_empty);
            run.frame();
            LayersOracle oracle(run, 4, 2);
            LayerTextures stored(run);
            double held = 0, opacity = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x)
                    held += 0.25 * oracle.maps.holds(0, x, y);
            for (int place = 0; place < run.read_buffer<int>("lrsm.summary")[0]; ++place)
                for (int y = 0; y < 32; ++y)
                    for (int x = 0; x < 32; ++x)
                        opacity += stored.at(place, x, y).normal.a;
            EXPECT_GT(held, 800);
            EXPECT_EQ(opacity, held) << "a floor at " << height << " under a "
                                     << (light.type == LightType::spot ? "spot" : "sun");
        }
    }
}
