// Means over windows inside a mask, by closed forms: constants, masks, borders, and what they do to noise.

#include "core/comparison.h"
#include "core/error.h"
#include "core/window_mean.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

using namespace bounce;

namespace {

Image made(int width, int height, int channels, auto&& value) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                image.at(x, y)[c] = value(x, y, c);
    return image;
}

/// +1 and −1 like a chessboard.
float chess(int x, int y) {
    return (x + y) % 2 ? -1.0f : 1.0f;
}

Mask with_holes(int width, int height) {
    Mask mask(width, height);
    for (size_t i = 0; i < mask.keep.size(); i += 3)
        mask.keep[i] = 0;
    return mask;
}

LayeredImage picture(Image image) {
    LayeredImage out;
    out.layers["out.direct"] = std::move(image);
    return out;
}

PartComparison compare(const Image& a, const Image& b, int window) {
    ComparisonOptions options;
    options.window = window;
    options.shown = false;
    return compare_layers(picture(a), picture(b), options).parts.front();
}

} // namespace

TEST(WindowMean, LeavesAConstantAsItIs) {
    const Image constant = made(9, 7, 3, [](int, int, int c) { return 0.1f + float(c); });
    for (int n : {1, 3, 5, 99}) {
        EXPECT_EQ(window_mean(constant, Mask(9, 7), n).pixels, constant.pixels) << n;
        EXPECT_EQ(window_mean(constant, with_holes(9, 7), n).pixels, constant.pixels) << n;
    }
}

TEST(WindowMean, TakesInWhatTheMaskKeepsAndNothingElse) {
    // What is dropped is enormous: any share of it would show.
    const Mask mask = with_holes(8, 5);
    const Image image = made(8, 5, 1, [&](int x, int y, int) { return mask.keep[size_t(y * 8 + x)] ? 2.0f : 1e30f; });
    const Image means = window_mean(image, mask, 3);
    for (size_t i = 0; i < means.pixels.size(); ++i)
        EXPECT_EQ(means.pixels[i], mask.keep[i] ? 2.0f : 1e30f) << i;
}

TEST(WindowMean, IsCutAtTheBorder) {
    const Image ramp = made(6, 4, 1, [](int x, int y, int) { return float(10 * y + x); });
    const Image means = window_mean(ramp, Mask(6, 4), 3);
    EXPECT_EQ(*means.at(2, 1), 12); // inside, a ramp is its own mean
    EXPECT_EQ(*means.at(0, 0), (0 + 1 + 10 + 11) / 4.0f);
    EXPECT_EQ(*means.at(3, 0), (2 + 3 + 4 + 12 + 13 + 14) / 6.0f);
    EXPECT_EQ(*means.at(5, 3), (24 + 25 + 34 + 35) / 4.0f);
    // A window larger than the picture is the mean of all of it.
    EXPECT_FLOAT_EQ(*window_mean(ramp, Mask(6, 4), 99).at(4, 2), 17.5f);
}

TEST(WindowMean, RefusesAnEvenWindow) {
    EXPECT_THROW(window_mean(Image(3, 3, 1), Mask(3, 3), 2), Error);
    EXPECT_THROW(window_mean(Image(3, 3, 1), Mask(3, 3), 0), Error);
    EXPECT_THROW(compare(Image(3, 3, 3), Image(3, 3, 3), 4), Error);
}

TEST(WindowMean, TakesFineErrorsAwayAndKeepsTheBias) {
    // 1 + 0.5 ± 0.3 against 1. Inside, the mean of nine of the chessboard is ±1/9 of it; the bias stays.
    const int n = 30;
    const Image one = made(n, n, 3, [](int, int, int) { return 1.0f; });
    const Image other = made(n, n, 3, [](int x, int y, int) { return 1.5f + 0.3f * chess(x, y); });
    const PartComparison part = compare(other, one, 3);
    EXPECT_NEAR(part.figures["relative_rmse"], std::sqrt(0.25 + 0.09), 1e-6);
    EXPECT_NEAR(part.figures["bias"], 0.5, 1e-6);
    EXPECT_NEAR(part.windowed["bias"], 0.5, 1e-3);
    // Of 900 pixels, 4 corners (mean of four: 0) and 4 · 28 edges (six: 0) lose the chessboard altogether.
    const double left = 0.09 / 81 * (28.0 * 28) / 900;
    EXPECT_NEAR(part.windowed["relative_rmse"], std::sqrt(0.25 + left), 1e-4);
    // The picture without the means stands beside, as if no window had been asked for.
    EXPECT_EQ(compare(other, one, 1).figures["relative_rmse"], part.figures["relative_rmse"]);
    EXPECT_TRUE(compare(other, one, 1).windowed.empty());
    EXPECT_FALSE(part.windowed.find("ssim"));
}

TEST(WindowMean, NoiseFallsAsItsFactorSays) {
    const int n = 128;
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    const Image noise = made(n, n, 1, [&](int, int, int) { return normal(random); });
    for (const Mask& mask : {Mask(n, n), with_holes(n, n)}) {
        const Image means = window_mean(noise, mask, 5);
        const Image zero(n, n, 1);
        const double before = error_figures(noise, zero, mask).rmse, after = error_figures(means, zero, mask).rmse;
        EXPECT_NEAR(after / before, window_noise_factor(mask, 5), 0.02);
    }
    EXPECT_NEAR(window_noise_factor(Mask(1000, 1000), 5), 0.2, 0.001);
    EXPECT_EQ(window_noise_factor(Mask(7, 7), 1), 1);
}

TEST(WindowMean, TheReferencesNoiseFallsWithIt) {
    LayeredImage reference = picture(made(40, 40, 3, [](int, int, int) { return 2.0f; }));
    reference.metadata = R"({"noise":{"out.direct":{"rms":0.2,"rms_off_edges":0.2}}})";
    ComparisonOptions options;
    options.window = 3;
    options.shown = false;
    const PartComparison part = compare_layers(reference, reference, options).parts.front();
    EXPECT_NEAR(part.figures["reference_noise"], 0.1, 1e-9);
    EXPECT_NEAR(part.windowed["reference_noise"], 0.1 * window_noise_factor(Mask(40, 40), 3), 1e-9);
    EXPECT_NEAR(part.windowed["reference_noise"], 0.1 / 3, 0.002);
}
