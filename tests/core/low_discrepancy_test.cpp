// The sequences are what they say: known first points, stratification, and unbiased scrambling.

#include "core/error.h"
#include "core/low_discrepancy.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace bounce;

TEST(LowDiscrepancy, RadicalInverseMirrorsTheDigits) {
    EXPECT_DOUBLE_EQ(radical_inverse(2, 0), 0.0);
    EXPECT_DOUBLE_EQ(radical_inverse(2, 1), 0.5);
    EXPECT_DOUBLE_EQ(radical_inverse(2, 6), 0.375);
    EXPECT_DOUBLE_EQ(radical_inverse(3, 5), 2.0 / 3 + 1.0 / 9);
    EXPECT_DOUBLE_EQ(halton(1, 5), radical_inverse(3, 5));
    EXPECT_THROW(halton(16, 0), Error);
}

TEST(LowDiscrepancy, SobolMatchesItsDirectionNumbers) {
    // Dimension 2 of Joe and Kuo (s = 1, a = 0, m = 1): v_1 = 2^31 and v_k = v_{k-1} xor (v_{k-1} >> 1).
    uint32_t direction[32];
    direction[0] = 0x80000000u;
    for (int k = 1; k < 32; ++k)
        direction[k] = direction[k - 1] ^ (direction[k - 1] >> 1);
    for (uint32_t i = 0; i < 5000; ++i) {
        uint32_t index = i * 858993u;
        uint32_t expected = 0;
        for (int bit = 0; bit < 32; ++bit) {
            if (index >> bit & 1) expected ^= direction[bit];
        }
        ASSERT_EQ(sobol_second(index), expected) << index;
    }
}

TEST(LowDiscrepancy, PixelSamplesAreStratifiedInEveryElementaryInterval) {
    for (uint32_t seed : {1u, 77u, 123456u}) {
        for (int shape = 0; shape <= 6; ++shape) { // 64 samples in 2^shape x 2^(6-shape) boxes: one in each
            std::set<int> boxes[3];
            for (uint32_t i = 0; i < 64; ++i) {
                PixelSampler sampler(seed, i, true);
                for (auto& box : boxes) {
                    glm::vec2 p = sampler.next_pair();
                    int columns = 1 << shape;
                    box.insert(int(p.x * float(columns)) + columns * int(p.y * float(64 / columns)));
                }
            }
            for (const auto& box : boxes)
                EXPECT_EQ(box.size(), 64u) << seed << " " << shape;
        }
        std::set<int> strata;
        for (uint32_t i = 0; i < 256; ++i)
            strata.insert(int(256 * PixelSampler(seed, i, true).next()));
        EXPECT_EQ(strata.size(), 256u);
    }
}

// Over many seeds each sample is uniform and pairs of dimensions are uncorrelated: scrambling does not bias.
TEST(LowDiscrepancy, ScrambledPointsAreUniformOverSeeds) {
    for (bool stratified : {true, false}) {
        for (uint32_t sample : {0u, 1u, 2u, 5u, 1000u}) {
            const int count = 40000;
            double sum = 0, squares = 0, product = 0, across = 0;
            for (int seed = 0; seed < count; ++seed) {
                PixelSampler sampler(hash_u32(uint32_t(seed)), sample, stratified);
                glm::vec2 a = sampler.next_pair();
                glm::vec2 b = sampler.next_pair();
                sum += a.x + a.y;
                squares += a.x * a.x + a.y * a.y;
                product += (a.x - 0.5) * (a.y - 0.5);
                across += (a.x - 0.5) * (b.x - 0.5);
                ASSERT_TRUE(a.x >= 0 && a.x < 1 && a.y >= 0 && a.y < 1);
            }
            EXPECT_NEAR(sum / (2 * count), 0.5, 5 * std::sqrt(1.0 / 12 / (2 * count)));
            EXPECT_NEAR(squares / (2 * count), 1.0 / 3, 0.006);
            EXPECT_NEAR(product / count, 0.0, 5.0 / 12 / std::sqrt(double(count)));
            EXPECT_NEAR(across / count, 0.0, 5.0 / 12 / std::sqrt(double(count)));
        }
    }
}

TEST(LowDiscrepancy, StratifiedSamplesIntegrateFasterThanRandomOnes) {
    auto error = [](bool stratified) {
        double squares = 0;
        for (uint32_t seed = 0; seed < 64; ++seed) {
            double sum = 0;
            for (uint32_t i = 0; i < 256; ++i) {
                glm::vec2 p = PixelSampler(hash_u32(seed), i, stratified).next_pair();
                sum += p.x * p.x * p.y;
            }
            double difference = sum / 256 - 1.0 / 6;
            squares += difference * difference;
        }
        return std::sqrt(squares / 64);
    };
    EXPECT_LT(error(true), 0.1 * error(false));
}
