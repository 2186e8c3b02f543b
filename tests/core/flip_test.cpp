// FLIP against values worked out by hand from the paper's formulas, and against a direct transcription of them.

#include "core/error.h"
#include "core/flip.h"
#include "core/heat_map.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace bounce;

namespace {

Image flat(int width, int height, float r, float g, float b) {
    Image image(width, height, 3);
    for (size_t i = 0; i < image.pixels.size(); i += 3) {
        image.pixels[i] = r;
        image.pixels[i + 1] = g;
        image.pixels[i + 2] = b;
    }
    return image;
}

double mean_flip(const Image& a, const Image& b, float ppd = k_flip_pixels_per_degree) {
    return flip_mean(flip(a, b, ppd), Mask(a.width, a.height));
}

} // namespace

TEST(Flip, DefaultDisplayIsThePapers) {
    EXPECT_NEAR(pixels_per_degree(0.7f, 0.7f, 3840), k_flip_pixels_per_degree, 1e-4f);
    EXPECT_THROW(pixels_per_degree(0, 0.7f, 3840), Error);
}

TEST(Flip, EqualImagesDoNotDiffer) {
    EXPECT_EQ(mean_flip(flat(9, 7, 0.2f, 0.5f, 0.9f), flat(9, 7, 0.2f, 0.5f, 0.9f)), 0.0);
}

// Flat images have no features and pass the contrast filter unchanged, so FLIP is the redistributed HyAB distance.
TEST(Flip, FlatColoursFollowTheClosedForm) {
    // Green against blue is the largest difference there is, by definition of the redistribution.
    EXPECT_NEAR(mean_flip(flat(8, 8, 0, 1, 0), flat(8, 8, 0, 0, 1)), 1.0, 1e-4);
    // Black against white: HyAB is 100 (no chroma), 100^0.7 = 25.1189, c_max = 41.2761, 0.4·c_max = 16.5104,
    // 0.95 + 0.05·(25.1189 − 16.5104)/(41.2761 − 16.5104) = 0.96738.
    EXPECT_NEAR(mean_flip(flat(8, 8, 0, 0, 0), flat(8, 8, 1, 1, 1)), 0.96738, 1e-4);
    EXPECT_NEAR(mean_flip(flat(8, 8, 1, 0, 0), flat(8, 8, 0, 1, 0)), 0.98666, 1e-4);
    // L* of 0.2 and 0.25 are 51.8372 and 57.0754; (0.95/16.5104)·5.2382^0.7 = 0.18340.
    EXPECT_NEAR(mean_flip(flat(8, 8, .2f, .2f, .2f), flat(8, 8, .25f, .25f, .25f)), 0.18340, 1e-4);
}

TEST(Flip, IsSymmetricAndBounded) {
    Image a = flat(20, 20, 0.1f, 0.4f, 0.2f), b = a;
    for (size_t i = 0; i < b.pixels.size(); ++i)
        b.pixels[i] = float((i * 7919) % 101) / 50; // some above 1: clamped
    Image forward = flip(a, b), backward = flip(b, a);
    for (size_t i = 0; i < forward.pixels.size(); ++i) {
        EXPECT_NEAR(forward.pixels[i], backward.pixels[i], 1e-5f);
        EXPECT_GE(forward.pixels[i], 0.0f);
        EXPECT_LE(forward.pixels[i], 1.0f);
    }
}

// The expected values come from a transcription in double precision with whole two-dimensional kernels.
TEST(Flip, MatchesTheDirectTranscription) {
    Image reference(16, 12, 3), test(16, 12, 3);
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 16; ++x) {
            for (int c = 0; c < 3; ++c) {
                float value = float((3 * x + 5 * y + 7 * c) % 16) / 15;
                reference.at(x, y)[c] = value;
                test.at(x, y)[c] = c == 1 && y >= 6 ? 0.25f : value * (x < 8 ? 1.0f : 0.6f);
            }
        }
    }
    Image coarse = flip(test, reference, 20);
    EXPECT_NEAR(flip_mean(coarse, Mask(16, 12)), 0.5561992, 2e-4);
    EXPECT_NEAR(*coarse.at(7, 5), 0.1608907, 2e-4);
    EXPECT_NEAR(*coarse.at(15, 11), 0.9565616, 2e-4);
    Image fine = flip(test, reference);
    EXPECT_NEAR(flip_mean(fine, Mask(16, 12)), 0.4984308, 2e-4);
    EXPECT_NEAR(*fine.at(0, 0), 0.0476018, 2e-4);
    EXPECT_NEAR(*fine.at(15, 11), 0.6741298, 2e-4);

    // A step edge against a flat grey: the feature term raises the error at the edge.
    Image edge = flat(32, 8, 0.3f, 0.3f, 0.3f), grey = flat(32, 8, 0.5f, 0.5f, 0.5f);
    for (int y = 0; y < 8; ++y) {
        for (int x = 16; x < 32; ++x)
            std::fill_n(edge.at(x, y), 3, 0.7f);
    }
    Image map = flip(edge, grey, 20);
    EXPECT_NEAR(*map.at(15, 4), 0.6272514, 2e-4);
    EXPECT_NEAR(*map.at(16, 4), 0.5734059, 2e-4);
    EXPECT_NEAR(*map.at(0, 4), 0.3725084, 2e-4);
    EXPECT_NEAR(*map.at(31, 4), 0.3068544, 2e-4);
}

// Detail finer than the eye resolves is filtered away: the same checkerboard differs less from its mean when far off.
TEST(Flip, FineDetailVanishesWithDistance) {
    Image board(64, 64, 3), grey = flat(64, 64, 0.5f, 0.5f, 0.5f);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x)
            std::fill_n(board.at(x, y), 3, (x + y) % 2 ? 1.0f : 0.0f);
    }
    EXPECT_LT(mean_flip(board, grey, 200), 0.5 * mean_flip(board, grey, 10));
}

TEST(Flip, BadInputIsNamed) {
    Image a = flat(4, 4, 0, 0, 0), b = flat(4, 5, 0, 0, 0);
    EXPECT_THROW(flip(a, b), Error);
    EXPECT_THROW(flip(Image(4, 4, 1), Image(4, 4, 1)), Error);
    EXPECT_THROW(flip(a, a, 0), Error);
    b = a;
    b.pixels[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(flip(a, b), Error);
}

TEST(HeatMap, BrightensSteadily) {
    float before = -1;
    for (int i = 0; i <= 100; ++i) {
        glm::vec3 colour = magma(float(i) / 100);
        float y = 0.2126f * srgb_decode(colour.r) + 0.7152f * srgb_decode(colour.g) + 0.0722f * srgb_decode(colour.b);
        EXPECT_GE(y, before - 1e-4f) << i;
        before = y;
    }
    EXPECT_GT(before, 0.85f);
    EXPECT_LT(magma(0).r + magma(0).g + magma(0).b, 0.02f);
}

TEST(HeatMap, MarksNanAndMaskedPixels) {
    Image values(3, 1, 1);
    values.pixels = {0.0f, std::numeric_limits<float>::quiet_NaN(), 0.5f};
    Mask mask(3, 1);
    mask.keep[2] = 0;
    Image8 map = heat_map(values, 0, 1, mask);
    EXPECT_EQ(map.rgba, (std::vector<uint8_t>{0, 0, 0, 255, 0, 255, 0, 255, 89, 89, 89, 255}));
    EXPECT_THROW(heat_map(values, 1, 1), Error);
}
