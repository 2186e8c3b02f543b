// V(z_c, r_c) of Eq. 12, by table and by formula, against the integral of the Gaussian; and the decay of layers,
// Eq. 15.
#include "lrsm/hand_made.h"

#include <cmath>

using namespace bounce;

namespace {

/// ∫ of the normal density of μ, σ over [from, to], by Simpson's rule over what lies within 12 σ.
double mass(double mu, double sigma, double from, double to) {
    double a = std::max((from - mu) / sigma, -12.0), b = std::min((to - mu) / sigma, 12.0);
    if (b <= a) return 0;
    constexpr int k_steps = 2000;
    double h = (b - a) / k_steps, sum = 0;
    for (int k = 0; k <= k_steps; ++k) {
        double x = a + k * h;
        sum += (k == 0 || k == k_steps ? 1 : k % 2 ? 4 : 2) * std::exp(-0.5 * x * x);
    }
    return sum * h / 3 / std::sqrt(2 * M_PI);
}

/// μ, σ, z, r of sample i; σ from far below its floor to the whole layer.
struct Sample {
    double mu, sigma, z, r;
    explicit Sample(int i)
        : mu((i % 7) / 6.0), sigma(std::pow(4.0, i / 7 % 6 - 6) * 2), z(-0.1 + 1.2 * (i / 42 % 9) / 8),
          r(0.001 * std::pow(3.0, i / 378 % 7)) {}
};
const char* const k_sample = R"(float mu = float(i % 7) / 6.0, sigma = 2.0 * exp2(2.0 * float(i / 7 % 6 - 6));
    float z = -0.1 + 1.2 * float(i / 42 % 9) / 8.0, r = 0.001 * pow(3.0, float(i / 378 % 7));
    result.x = mass_between(mu, sigma * sigma, z - r, z + r);)";
constexpr int k_count = 7 * 6 * 9 * 7;

using NormalMass = HandMadeTest;
using LayerDecay = HandMadeTest;

} // namespace

TEST_F(NormalMass, IsTheIntegralOfTheGaussian) {
    for (bool formula : {false, true}) {
        auto run = make(k_count, k_sample, "", false, {{"sample.formula_for_cdf", formula ? "true" : "false"}});
        std::vector<glm::dvec4> got = results(*run);
        double worst = 0;
        int between = 0;
        for (int i = 0; i < k_count; ++i) {
            Sample s(i);
            double expected = mass(s.mu, std::max(s.sigma, 0.004), s.z - s.r, s.z + s.r);
            worst = std::max(worst, std::abs(got[size_t(i)].x - expected));
            between += expected > 0.01 && expected < 0.99;
        }
        fmt::print("    {}: greatest error {:.2e} over {} samples\n", formula ? "formula" : "table", worst, k_count);
        // Table: linear between entries 8/255 apart, 3e-5 for each Φ, filter weights of 8 bits, 2.5e-5, and 3.2e-5
        // where it ends at 4 σ. Formula: 1.4e-4 for each Φ, as its authors state.
        EXPECT_LT(worst, formula ? 2.9e-4 : 1.8e-4);
        EXPECT_GT(between, k_count / 10) << "most samples are nothing or all";
    }
}

/// σ² of 8- to 16-bit depths may come out zero or negative.
TEST_F(NormalMass, HasAFloorUnderTheStandardDeviation) {
    auto run = make(3, R"(result = vec4(mass_between(0.5, i == 0 ? 0.0 : (i == 1 ? -1.0e-4 : 1.0e-10), 0.5, 0.52));)",
                    "", false, {{"sample.smallest_sigma", "0.02"}});
    for (glm::dvec4 got : results(*run))
        EXPECT_NEAR(got.x, mass(0.5, 0.02, 0.5, 0.52), 2e-4); // one σ: .3413
}

/// The table itself: Φ at 256 points over [−4, 4].
TEST_F(NormalMass, TheTableHoldsTheDistribution) {
    auto run = make(1, "", "", false);
    std::vector<float> table = run->read("lrsm.normal_table");
    ASSERT_EQ(table.size(), 256u);
    for (int i = 0; i < 256; ++i)
        EXPECT_NEAR(table[size_t(i)], 0.5 * std::erfc(-(i / 255.0 * 8 - 4) / std::sqrt(2.0)), 1e-6) << i;
}

/// k(s) + k(1 − s) = 1: two layers that overlap sum to one there; the scene's ends do not fade.
TEST_F(LayerDecay, SumsToOneEverywhere) {
    auto run = make(601,
                    R"(float z = 0.5 + 7.0 * float(i) / 600.0;
    Partition p = partitions[0];
    for (int d = 0; d < 3; ++d) {
        vec2 range = layer_range(p, d);
        bool inside = (d == 0 || z >= range.x) && (d == 2 || z <= range.y);
        result[d] = inside ? layer_decay(p, d, z) : 0.0;
    }
    result.w = z;)",
                    "", false);
    int fading = 0;
    for (glm::dvec4 got : results(*run)) {
        EXPECT_NEAR(got.x + got.y + got.z, 1, 1e-5) << "z = " << got.w;
        for (int d = 0; d < 3; ++d) {
            EXPECT_GE(got[d], 0);
            fading += got[d] > 0.01 && got[d] < 0.99;
        }
        // Boundaries 2 and 4 with an overlap of .4: whole in between, ends included.
        if (got.w < 1.8 || (got.w > 2.2 && got.w < 3.8) || got.w > 4.2) {
            EXPECT_EQ(std::max({got.x, got.y, got.z}), 1) << "z = " << got.w;
        }
    }
    EXPECT_GT(fading, 50);
}
