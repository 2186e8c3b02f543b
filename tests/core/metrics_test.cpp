// Every figure against values worked out by hand on images of a few pixels.

#include "core/metrics.h"
#include "support/errors.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

using namespace bounce;

namespace {

Image grey(std::vector<float> values, int width) {
    Image image(width, int(values.size()) / width, 1);
    image.pixels = std::move(values);
    return image;
}

} // namespace

TEST(Metrics, FiguresOfFourPixels) {
    // a = 2 1 0 5, b = 1 1 2 4: differences 1 0 −2 1, means 2 and 2.
    ErrorFigures figures = error_figures(grey({2, 1, 0, 5}, 2), grey({1, 1, 2, 4}, 2));
    EXPECT_EQ(figures.pixels, 4u);
    EXPECT_DOUBLE_EQ(figures.mean, 2);
    EXPECT_DOUBLE_EQ(figures.reference_mean, 2);
    EXPECT_DOUBLE_EQ(figures.bias, 0);
    EXPECT_DOUBLE_EQ(figures.rmse, std::sqrt(6.0 / 4));
    EXPECT_DOUBLE_EQ(figures.relative_rmse, std::sqrt(6.0 / 4) / 2);
    EXPECT_DOUBLE_EQ(figures.relative_mse, (1 / 1.04 + 0 + 4 / 4.04 + 1 / 16.04) / 4);
    EXPECT_DOUBLE_EQ(figures.smape, (1.0 / 3 + 0 + 1 + 1.0 / 9) / 4);
    EXPECT_DOUBLE_EQ(figures.relative_error_p99, 1 / 1.02 > 2 / 2.02 ? 1 / 1.02 : 2 / 2.02);
    EXPECT_DOUBLE_EQ(figures.largest_error, 2);
}

TEST(Metrics, BiasIsTheRatioOfMeans) {
    EXPECT_NEAR(error_figures(grey({1.1f, 2.2f}, 2), grey({1, 2}, 2)).bias, 0.1, 1e-6);
    EXPECT_NEAR(error_figures(grey({0.25f, 0.25f}, 2), grey({1, 0}, 2)).bias, -0.5, 1e-12);
    EXPECT_EQ(error_figures(grey({0, 0}, 2), grey({0, 0}, 2)).bias, 0);
    EXPECT_TRUE(std::isinf(error_figures(grey({1, 0}, 2), grey({0, 0}, 2)).bias));
}

TEST(Metrics, ThePercentileIsOverPixels) {
    std::vector<float> a(1000, 1.0f), b(1000, 1.0f);
    for (int i = 0; i < 10; ++i)
        a[size_t(i) * 90] = 3; // exactly 1 % of the pixels are off: the percentile misses them
    EXPECT_EQ(error_figures(grey(a, 100), grey(b, 100)).relative_error_p99, 0);
    a[7] = 3; // and with one more it does not
    EXPECT_NEAR(error_figures(grey(a, 100), grey(b, 100)).relative_error_p99, 2 / 1.01, 1e-9);
}

TEST(Metrics, MaskedPixelsDoNotCount) {
    Mask mask(2, 2);
    mask.keep[3] = 0;
    ErrorFigures figures = error_figures(grey({1, 1, 1, 100}, 2), grey({1, 1, 1, 0}, 2), mask);
    EXPECT_EQ(figures.pixels, 3u);
    EXPECT_EQ(figures.rmse, 0);
    EXPECT_EQ(ssim(grey({1, 1, 1, 1}, 2), grey({1, 1, 1, 1}, 2), mask), 1);
}

TEST(Metrics, ReferenceNoiseIsTakenOff) {
    // A difference of RMS 0.5 to a reference whose own noise is 0.4: 0.3 are left.
    ErrorFigures figures = error_figures(grey({2.5f, 1.5f}, 2), grey({2, 2}, 2), Mask(2, 1), 0.4);
    EXPECT_DOUBLE_EQ(figures.relative_rmse, 0.25);
    EXPECT_DOUBLE_EQ(figures.reference_noise, 0.2);
    EXPECT_NEAR(figures.relative_rmse_denoised, 0.15, 1e-9);
    figures = error_figures(grey({2.5f, 1.5f}, 2), grey({2, 2}, 2), Mask(2, 1), 0.6);
    EXPECT_EQ(figures.relative_rmse_denoised, 0);
    EXPECT_DOUBLE_EQ(half_image_noise(grey({1, 3}, 2), grey({3, 3}, 2), Mask(2, 1)), std::sqrt(0.5));
}

TEST(Metrics, BadInputSaysWhere) {
    Image a(4, 3, 3), b(4, 3, 3);
    a.at(2, 1)[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(error_of([&] { error_figures(a, b); }),
                testing::AllOf(testing::HasSubstr("(2, 1), channel 1"), testing::HasSubstr("NaN")));
    b.at(0, 2)[0] = std::numeric_limits<float>::infinity();
    EXPECT_THAT(error_of([&] { error_figures(Image(4, 3, 3), b); }),
                testing::AllOf(testing::HasSubstr("the reference"), testing::HasSubstr("infinite")));
    EXPECT_THAT(error_of([&] { error_figures(Image(4, 3, 3), Image(4, 4, 3)); }),
                testing::AllOf(testing::HasSubstr("4x3"), testing::HasSubstr("4x4")));
    Mask none(4, 3);
    std::fill(none.keep.begin(), none.keep.end(), uint8_t{0});
    EXPECT_THAT(error_of([&] { error_figures(Image(4, 3, 3), Image(4, 3, 3), none); }),
                testing::HasSubstr("keeps no pixel"));
    EXPECT_THROW(error_figures(Image(4, 3, 3), Image(4, 3, 3), Mask(3, 3)), Error);
}

TEST(Metrics, SsimOfFlatImagesIsItsLuminanceTerm) {
    Image a(16, 16, 3), b(16, 16, 3);
    std::fill(a.pixels.begin(), a.pixels.end(), srgb_decode(0.4f));
    std::fill(b.pixels.begin(), b.pixels.end(), srgb_decode(0.6f));
    Mask all(16, 16);
    EXPECT_NEAR(ssim(a, b, all), (2 * 0.24 + 1e-4) / (0.16 + 0.36 + 1e-4), 5e-5);
    EXPECT_NEAR(ssim(a, a, all), 1, 1e-9);
}

TEST(Metrics, SsimOfAnInvertedPatternIsNegative) {
    Image a(32, 32, 1), b(32, 32, 1);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            *a.at(x, y) = (x + y) % 2 ? 1.0f : 0.0f;
            *b.at(x, y) = (x + y) % 2 ? 0.0f : 1.0f;
        }
    }
    // In the middle, means are ½ and variances ¼; the covariance is −¼: (−½ + C₂)/(½ + C₂).
    Mask middle(32, 32);
    std::fill(middle.keep.begin(), middle.keep.end(), uint8_t{0});
    middle.keep[16 * 32 + 16] = 1;
    EXPECT_NEAR(ssim(a, b, middle), (-0.5 + 9e-4) / (0.5 + 9e-4), 2e-3);
}

TEST(Masks, EdgesAreDroppedAtDepthStepsCreasesAndTheBackground) {
    // A floor seen from above in columns 0-3, a step 5 cm up in columns 4-6, a wall in columns 7-8, background in 9.
    Image normal(10, 3, 3), position(10, 3, 3);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 9; ++x) {
            bool wall = x >= 7;
            float* n = normal.at(x, y);
            n[0] = wall ? -1.0f : 0.0f;
            n[1] = wall ? 0.0f : 1.0f;
            float* p = position.at(x, y);
            p[0] = wall ? 0.7f : 0.1f * float(x);
            p[1] = x < 4 ? 0.0f : wall ? 0.05f + 0.1f * float(x - 6) : 0.05f;
            p[2] = 0.1f * float(y);
        }
    }
    Mask mask = edge_mask(normal, position, {0, 2, 0});
    std::string row;
    for (int x = 0; x < 10; ++x)
        row += mask.keep[size_t(10 + x)] ? '1' : '0';
    EXPECT_EQ(row, "1110010000"); // 5 cm are more than 1 % of 2 m
    mask = edge_mask(normal, position, {0, 20, 0});
    row.clear();
    for (int x = 0; x < 10; ++x)
        row += mask.keep[size_t(10 + x)] ? '1' : '0';
    EXPECT_EQ(row, "1111110000"); // but less than 1 % of 20 m
    EXPECT_EQ(surface_mask(normal).count(), 27u);
    EXPECT_EQ((mask & surface_mask(normal)).count(), 18u);
    EXPECT_THROW(mask & Mask(3, 3), Error);
}

TEST(Masks, SurfacesAreMaterialsByDominantAxis) {
    Image material = grey({2, 2, 3, 0}, 4), normal(4, 1, 3);
    normal.at(0, 0)[1] = 1;
    normal.at(1, 0)[2] = -1;
    normal.at(2, 0)[1] = 1;
    Image ids = surface_ids(material, normal);
    EXPECT_THAT(ids.pixels, testing::ElementsAre(14, 17, 20, -1));
    EXPECT_EQ(component_mask(ids, 17).count(), 1u);
    EXPECT_EQ(component_counts(ids).size(), 3u);
    EXPECT_EQ(component_counts(material).front(), (std::pair<int, size_t>(2, 2)));
}

TEST(Metrics, DisplayValuesStayInRange) {
    Image image = grey({-1, 0, 0.18f, 1, 100, 1e30f}, 6);
    Image display = display_values(image, 0);
    for (float value : display.pixels)
        EXPECT_TRUE(value >= 0 && value <= 1);
    EXPECT_EQ(display.pixels[1], 0);
    EXPECT_NEAR(display.pixels[3], 0.8038f, 1e-3f);
    EXPECT_EQ(display.pixels[5], 1);
    EXPECT_NEAR(automatic_exposure(grey({0.09f, 0.09f}, 2), Mask(2, 1)), 1, 1e-5f);
    EXPECT_EQ(automatic_exposure(grey({0, 0}, 2), Mask(2, 1)), 0);
}
