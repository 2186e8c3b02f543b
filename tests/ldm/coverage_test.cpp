// Blended surfaces in layered depth maps: a fragment is there with the probability alpha, on each route alike.
#include "lists_fixture.h"

namespace bounce {
namespace {

/// Boxes and boards whose alpha is `alpha`, each a draw.
Scene blended_blocks(float alpha, AlphaMode mode) {
    Scene scene = blocks();
    for (Material& material : scene.materials) {
        material.base_colour.a = alpha;
        material.alpha_mode = mode;
    }
    return scene;
}

class LdmCoverage : public LdmTest {
  protected:
    std::vector<uint32_t> lists(float alpha, AlphaMode mode, Sets sets, size_t& fragments) {
        sets.insert(sets.end(), {{"ldm.maps", "8"}, {"ldm.resolution", "48"}, {"ldm.tilted", "true"}});
        SceneRunner run(blended_blocks(alpha, mode), {}, graph_file(k_maps_alone), sets);
        whole_frame(run);
        const LdmLists found(run);
        fragments = 0;
        for (int head = 0; head < found.info.heads; ++head) {
            const int n = found.info.resolution;
            fragments += found.list(head / (n * n), head % n, head / n % n).size();
        }
        return found.canonical();
    }
};

} // namespace

TEST_F(LdmCoverage, FragmentsAreThereByTheirAlpha) {
    for (const Sets& route : {Sets{}, Sets{{"ldm.route", "compute"}}}) {
        size_t all = 0, opaque = 0, none = 0;
        const std::vector<uint32_t> one = lists(1, AlphaMode::blend, route, all);
        EXPECT_EQ(one, lists(1, AlphaMode::opaque, route, opaque));
        lists(0, AlphaMode::blend, route, none);
        EXPECT_EQ(none, 0u);
        for (float alpha : {0.3f, 0.8f}) {
            size_t some = 0;
            lists(alpha, AlphaMode::blend, route, some);
            fmt::print("    alpha {}: {:.3f} of {} fragments\n", alpha, double(some) / double(all), all);
            EXPECT_NEAR(double(some) / double(all), double(alpha),
                        4 * std::sqrt(double(alpha * (1 - alpha)) / double(all)));
        }
    }
}

} // namespace bounce
