// Smaller levels of a texture keep its light.

#include "core/mip_chain.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace bounce;

namespace {

Image8 noise(int width, int height, int low, int high) {
    Image8 image{width, height, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    uint32_t state = 7;
    for (uint8_t& code : image.rgba) {
        state = state * 1664525u + 1013904223u;
        code = uint8_t(low + int((state >> 16) % uint32_t(high - low + 1)));
    }
    return image;
}

double mean(const Image8& image, size_t channel, bool srgb) {
    double sum = 0;
    for (size_t i = channel; i < image.rgba.size(); i += 4) {
        const float value = float(image.rgba[i]) / 255;
        sum += srgb ? srgb_decode(value) : value;
    }
    return sum / double(image.rgba.size() / 4);
}

} // namespace

TEST(MipChain, EndsAtOneTexel) {
    const std::vector<Image8> levels = mip_chain(noise(20, 5, 0, 255), true);
    ASSERT_EQ(levels.size(), 4u);
    const int sizes[4][2] = {{10, 2}, {5, 1}, {2, 1}, {1, 1}};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(levels[i].width, sizes[i][0]);
        EXPECT_EQ(levels[i].height, sizes[i][1]);
        EXPECT_EQ(levels[i].rgba.size(), size_t(sizes[i][0] * sizes[i][1] * 4));
    }
    EXPECT_TRUE(mip_chain(noise(1, 1, 0, 255), true).empty());
}

TEST(MipChain, KeepsTheMeanOfDecodedValuesInEveryLevel) {
    for (const auto& [width, height] : {std::pair(64, 64), std::pair(37, 21), std::pair(1, 33)}) {
        for (bool srgb : {true, false}) {
            const Image8 image = noise(width, height, 40, 200);
            const std::vector<Image8> levels = mip_chain(image, srgb);
            for (size_t c = 0; c < 4; ++c) {
                const bool decoded = srgb && c < 3;
                const double whole = mean(image, c, decoded);
                for (const Image8& level : levels) {
                    // A code's step, 1/255, is up to 1.8 times as high where sRGB is steep; rounding takes half of it,
                    // and less on average over more texels.
                    const double texels = double(level.width) * level.height;
                    EXPECT_NEAR(mean(level, c, decoded), whole, 0.5 * 1.8 / 255 / std::sqrt(std::min(texels, 16.0)))
                        << width << "x" << height << " " << level.width << " srgb " << srgb << " channel " << c;
                }
            }
        }
    }
}

TEST(MipChain, BlackAndWhiteMakeTheCodeOfHalfTheLight) {
    Image8 image{2, 2, {0, 0, 0, 255, 255, 255, 255, 0, 255, 255, 255, 0, 0, 0, 0, 255}};
    EXPECT_EQ(mip_chain(image, true).back().rgba, (std::vector<uint8_t>{188, 188, 188, 128}));
    EXPECT_EQ(mip_chain(image, false).back().rgba, (std::vector<uint8_t>{128, 128, 128, 128}));
}

// Thin leaves in a masked texture: means of alpha fall below the cutoff from level 2 on, and all would be gone.
TEST(MipChain, KeepsTheShareThatPassesAMask) {
    Image8 image = noise(64, 64, 0, 255);
    for (size_t i = 3; i < image.rgba.size(); i += 4)
        image.rgba[i] = image.rgba[i] > 195 ? 255 : uint8_t(image.rgba[i] / 5);
    auto share = [](const Image8& level, int cutoff) {
        double sum = 0;
        for (size_t i = 3; i < level.rgba.size(); i += 4)
            sum += level.rgba[i] >= cutoff;
        return sum / double(level.rgba.size() / 4);
    };
    for (int cutoff : {64, 128, 200}) {
        std::vector<Image8> plain = mip_chain(image, true), kept = plain;
        keep_coverage(image, kept, float(cutoff) / 255);
        EXPECT_LT(share(plain[3], cutoff), cutoff > 100 ? 0.1 : 1.1) << "the test is about something";
        for (const Image8& level : kept) {
            const double texels = double(level.width) * level.height;
            // Equal alphas pass or fail together.
            EXPECT_NEAR(share(level, cutoff), share(image, cutoff), 0.07 + 0.5 / texels)
                << level.width << " " << cutoff;
        }
        for (size_t i = 0; i < kept.size(); ++i)
            for (size_t c = 0; c < kept[i].rgba.size(); ++c) {
                if (c % 4 != 3) {
                    EXPECT_EQ(kept[i].rgba[c], plain[i].rgba[c]) << "colours stay";
                }
            }
    }
    // All or nothing stays all or nothing.
    std::vector<Image8> levels = mip_chain(image, false), before = levels;
    keep_coverage(image, levels, 0);
    keep_coverage(image, levels, 1.5f);
    for (size_t i = 0; i < levels.size(); ++i)
        EXPECT_EQ(levels[i].rgba, before[i].rgba);
}
