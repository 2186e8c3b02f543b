// How fine a scene is where it is seen, against closed forms; and that the numbers do not depend on the run.
#include "reference/feature_sizes.h"
#include "reference/scene_needs.h"

#include "scenes.h"

#include <gtest/gtest.h>

using namespace bounce;
using bounce::test::SceneMaker;

namespace {

/// Two plates of 2·k_half m, `gap` apart, seen from between them.
SceneMaker plates(float gap) {
    constexpr float k_half = 200;
    SceneMaker maker;
    const int grey = maker.material(glm::vec3(0.5f));
    maker.quad({-k_half, 0, k_half}, {2 * k_half, 0, 0}, {0, 0, -2 * k_half}, grey);
    maker.quad({-k_half, gap, -k_half}, {2 * k_half, 0, 0}, {0, 0, 2 * k_half}, grey);
    maker.shot.camera.position = {0, gap / 2, 0};
    maker.shot.camera.target = {1, -gap * 10, 0};
    maker.shot.camera.vfov = 1;
    return maker;
}

} // namespace

TEST(FeatureSizes, AGapIsTheMedianFreeLength) {
    // Cosine-weighted directions between plates: P(cosθ < c) = c², so half of the lengths gap/cosθ are below gap·√2.
    // The median of 16 directions scatters by 6 % a point, and the point in the middle of many by less.
    for (float gap : {0.5f, 2.0f}) {
        const FeatureSizes features = measure_features(plates(gap).shot);
        EXPECT_GT(features.points, 1000u);
        EXPECT_NEAR(features.gap_50, gap * std::sqrt(2.0f), 0.06f * gap);
        EXPECT_LT(features.gap_10, features.gap_50);
        EXPECT_GT(features.gap_10, gap) << "nothing is nearer than the other plate";
        EXPECT_NEAR(features.area, 2 * 400.0f * 400.0f, 1);
    }
}

TEST(FeatureSizes, OneRayVariesByTheShareThatIsLit) {
    // Between the plates a vertical sun cannot come in, so nothing is lit; a plate that shines evenly is met by all
    // rays.
    SceneMaker dark = plates(1);
    dark.light(LightType::directional, glm::vec3(0), {0, -1, 0}, 1);
    EXPECT_EQ(measure_features(dark.shot).lit_share, 0);
    EXPECT_EQ(measure_features(dark.shot).ray_variance, 0);

    SceneMaker bright = plates(1);
    for (Material& material : bright.shot.scene.materials)
        material.emission = glm::vec3(2);
    EXPECT_GT(measure_features(bright.shot).lit_share, 0.999f);
    EXPECT_LT(measure_features(bright.shot).ray_variance, 1e-3f);
}

TEST(FeatureSizes, AreTheSameInEveryRun) {
    const FeatureSizes a = measure_features(plates(1).shot), b = measure_features(plates(1).shot);
    EXPECT_EQ(a.gap_10, b.gap_10);
    EXPECT_EQ(a.ray_variance, b.ray_variance);
}
