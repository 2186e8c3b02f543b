// Algorithm 1 on layered reflective shadow maps made by hand, against the same sums in double precision.
#include "lrsm/hand_made.h"

#include <algorithm>

using namespace bounce;

namespace {

constexpr int k_count = 600;

/// Smooth in the plane, and different from layer to layer and from mip to mip, so that a wrong layer or mip shows.
const char* const k_layers = R"(float a = 0.35 + 0.1 * float(layer) + 0.04 * uv.x;
    float mu = 0.2 + 0.1 * float(layer) + 0.1 * uv.y, sigma = 0.05 + 0.03 * float(mip);
    radiance = a * vec4((1.0 + 0.5 * uv.x) * (1.0 + float(mip)), 0.5 + uv.y, 1.0 + float(layer), 0.4 + 0.05 * float(layer));
    normal = vec4(a * (0.6 + 0.05 * float(mip)) * normalize(vec3(0.3 * float(layer) - 0.8, 0.2, -1.0)), a);
    depth = a * vec4(mu, mu * mu + sigma * sigma, 1.0, 0.0);)";

/// Sphere i and the way to the viewer, as in GLSL below; z over all three layers and both boundaries.
struct Sphere {
    glm::dvec3 centre, to_viewer;
    double radius;
    explicit Sphere(int i) {
        double z = 0.8 + 6.4 * (i % 50) / 49;
        centre = {z * 0.8 * ((i / 50 % 4) / 1.5 - 1), z * 0.9 * ((i / 200) - 1.0), z};
        radius = 0.02 * z * std::exp2(5.0 * (i * 7 % 31) / 30);
        to_viewer = glm::normalize(glm::dvec3((i % 5) - 2.0, (i % 3) - 1.0, -1.5));
    }
};
const char* const k_spheres = R"(float z = 0.8 + 6.4 * float(i % 50) / 49.0;
    vec3 centre = vec3(z * 0.8 * (float(i / 50 % 4) / 1.5 - 1.0), z * 0.9 * (float(i / 200) - 1.0), z);
    float radius = 0.02 * z * exp2(5.0 * float(i * 7 % 31) / 30.0);
    vec3 to_viewer = normalize(vec3(float(i % 5) - 2.0, float(i % 3) - 1.0, -1.5));)";

/// The layers' textures of all mips, looked up between texels and mips.
struct Lookup {
    explicit Lookup(const SceneRunner& run) {
        for (int mip = 0; mip < k_hand_made_mips; ++mip)
            mips.emplace_back(run, mip);
    }
    std::vector<LayerTextures> mips;

    LayerTexel at(int place, glm::dvec2 uv, int mip) const {
        int size = mips[size_t(mip)].size.x;
        glm::dvec2 texel = uv * double(size) - 0.5, low = glm::floor(texel);
        LayerTexel sum;
        for (int corner = 0; corner < 4; ++corner) {
            glm::dvec2 share = texel - low;
            double weight = (corner & 1 ? share.x : 1 - share.x) * (corner & 2 ? share.y : 1 - share.y);
            add(sum, weight,
                mips[size_t(mip)].at(place, std::clamp(int(low.x) + (corner & 1), 0, size - 1),
                                     std::clamp(int(low.y) + (corner >> 1), 0, size - 1)));
        }
        return sum;
    }
    LayerTexel at(int place, glm::dvec2 uv, double level) const {
        level = std::clamp(level, 0.0, double(k_hand_made_mips - 1));
        int finer = int(level), coarser = std::min(finer + 1, k_hand_made_mips - 1);
        LayerTexel sum;
        add(sum, 1 - (level - finer), at(place, uv, finer));
        add(sum, level - finer, at(place, uv, coarser));
        return sum;
    }

  private:
    static void add(LayerTexel& sum, double weight, const LayerTexel& one) {
        sum.radiance += weight * one.radiance;
        sum.normal += weight * one.normal;
        sum.depth += weight * one.depth;
    }
};

double cumulative(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

/// Algorithm 1 with Eq. 8–15 over boundaries 1, 2, 4, 7 with an overlap of .4; layer (d, n) is stored at 5 − (2d + n).
glm::dvec3 algorithm_1(const Lookup& maps, const Sphere& sphere, bool orthographic, double finest_mip, int& layers) {
    double z = sphere.centre.z;
    double scale = orthographic ? 0.5 : 1 / z;
    glm::dvec2 uv = glm::dvec2(sphere.centre) * scale * 0.5 + 0.5;
    glm::dvec3 light(0);
    layers = 0;
    if (uv.x < 0 || uv.y < 0 || uv.x > 1 || uv.y > 1) return light;
    // The projected diameter in texels of the map, 32 wide: over 2z·tan 45°, or over 4 m. The layers have half as many.
    double texels = 2 * sphere.radius * 32 / (orthographic ? 4 : 2 * z);
    double level = std::max(std::log2(std::max(texels, 1.0)) - 1, finest_mip);
    const double boundaries[4] = {1, 2, 4, 7};
    for (int d = 0; d < 3; ++d) {
        double low = boundaries[d] - (d > 0 ? 0.2 : 0), high = boundaries[d + 1] + (d < 2 ? 0.2 : 0);
        if ((d > 0 && z < low) || (d < 2 && z > high)) continue;
        auto fade = [](double s) {
            s = std::clamp(s, 0.0, 1.0);
            return s * s * (3 - 2 * s);
        };
        double f = (d > 0 ? fade((z - low) / 0.4) : 1) * (d < 2 ? fade((high - z) / 0.4) : 1);
        for (int n = 0; n < 2; ++n) {
            if (d == 1 && n == 1) continue;
            LayerTexel texel = maps.at(5 - (2 * d + n), uv, level);
            double a = texel.normal.a;
            double facing = glm::dot(glm::dvec3(texel.normal) / a, sphere.to_viewer);
            if (facing <= 0) continue;
            double mu = texel.depth.r / texel.depth.b;
            double sigma = std::max(std::sqrt(std::max(texel.depth.g / texel.depth.b - mu * mu, 0.0)), 0.004);
            double centre = (z - low) / (high - low), radius = sphere.radius / (high - low);
            double inside = cumulative((centre + radius - mu) / sigma) - cumulative((centre - radius - mu) / sigma);
            light += f * inside * facing * glm::dvec3(texel.radiance); // A·R is what is stored
            ++layers;
        }
    }
    return light;
}

class Sampling : public HandMadeTest, public testing::WithParamInterface<bool> {
  protected:
    void compare(double finest_mip) {
        auto run =
            make(k_count, std::string(k_spheres) + "result.rgb = sample_view(0, centre, radius, to_viewer, 0.5);",
                 k_layers, GetParam(), {{"sample.finest_mip", fmt::format("{}", finest_mip)}});
        Lookup maps(*run);
        std::vector<glm::dvec4> got = results(*run);
        double worst = 0, brightest = 0, mean = 0;
        int lit = 0, in_overlap = 0;
        for (int i = 0; i < k_count; ++i) {
            int layers = 0;
            glm::dvec3 expected = algorithm_1(maps, Sphere(i), GetParam(), finest_mip, layers);
            double error = glm::length(glm::dvec3(got[size_t(i)]) - expected);
            worst = std::max(worst, error), mean += error / k_count;
            brightest = std::max(brightest, glm::length(expected));
            lit += glm::length(expected) > 0.05;
            in_overlap += layers > 2;
        }
        fmt::print("    {} lit of {}, {} in an overlap; error max {:.4f}, mean {:.5f} at up to {:.2f}\n", lit, k_count,
                   in_overlap, worst, mean, brightest);
        // Filters weigh with 8 bits (1/256 in each of two axes and in the level); V's table adds 1.8e-4.
        EXPECT_LT(worst, 0.012 * brightest);
        EXPECT_LT(mean, 0.001 * brightest);
        EXPECT_GT(lit, k_count / 5);
        EXPECT_GT(in_overlap, 5);
    }
};

} // namespace

TEST_P(Sampling, AsPublishedIsAlgorithm1) {
    compare(0);
}
TEST_P(Sampling, UnderAMipClampUsesNoFinerMips) {
    compare(2.5);
}
INSTANTIATE_TEST_SUITE_P(Views, Sampling, testing::Bool(),
                         [](auto& test) { return test.param ? "orthographic" : "perspective"; });

namespace {

/// Fully lit planes: the whole map at one depth, facing the light, in layer (1, 0) alone.
class OnALitPlane : public HandMadeTest {
  protected:
    /// Light of a sphere of `radius` at `z`, seen from the light's side at `tilt` degrees.
    glm::dvec4 sampled(double z, double radius, double tilt, double alpha, const std::string& layers,
                       std::vector<std::pair<std::string, std::string>> sets) {
        auto run =
            make(1,
                 fmt::format("float tilt = radians({:f}); result = vec4(sample_view(0, vec3(0.0, 0.0, {:f}), {:f}, "
                             "vec3(sin(tilt), 0.0, -cos(tilt)), {:f}), 1.0);",
                             tilt, z, radius, alpha),
                 layers, true, sets);
        return results(*run)[0];
    }
    /// μ so that the plane lies at z = 3 in [1.8, 4.2].
    std::string plane(const char* cosine) {
        return fmt::format(
            "if (layer == 3) {{ radiance = vec4(0.7, 0.5, 0.3, {}); normal = vec4(0.0, 0.0, -1.0, 1.0); depth "
            "= vec4(0.5, 0.25, 1.0, 0.0); }}",
            cosine);
    }
    static void expect_plane(glm::dvec4 got, double share, const std::string& what) {
        EXPECT_NEAR(got.r, 0.7 * share, 0.005) << what;
        EXPECT_NEAR(got.g, 0.5 * share, 0.005) << what;
        EXPECT_NEAR(got.b, 0.3 * share, 0.005) << what;
    }
};

} // namespace

/// Whatever the angles to light and viewer: what blocks the cone is lit, so L is the plane's radiance. As published, N
/// darkens instead.
TEST_F(OnALitPlane, TheLitFractionGivesItsRadiance) {
    std::vector<std::pair<std::string, std::string>> lit_fraction{{"sample.estimator", "lit_fraction"}};
    for (const char* cosine : {"1.0", "0.6", "0.2"}) {
        for (double tilt : {0.0, 40.0, 75.0}) {
            std::string what = fmt::format("cosine to the light {}, tilt {}", cosine, tilt);
            expect_plane(sampled(3, 0.2, tilt, -1, plane(cosine), lit_fraction), 1, what);
            // A sphere that is blocked as much as the plane covers it.
            double covered = std::cos(glm::radians(tilt));
            expect_plane(sampled(3, 0.2, tilt, covered, plane(cosine), lit_fraction), 1, what);
            expect_plane(sampled(3, 0.2, tilt, 0.5, plane(cosine), {}), covered, what + ", as published");
        }
    }
}

/// A sphere that is blocked by more than the map shows: only that share of it is lit.
TEST_F(OnALitPlane, TheLitFractionIsTheShareOfWhatBlocks) {
    std::string quarter =
        "if (layer == 3) { radiance = 0.25 * vec4(0.7, 0.5, 0.3, 1.0); normal = vec4(0.0, 0.0, -0.25, "
        "0.25); depth = 0.25 * vec4(0.5, 0.25, 1.0, 0.0); }";
    expect_plane(sampled(3, 0.2, 0, 1, quarter, {{"sample.estimator", "lit_fraction"}}), 0.25, "a quarter lit");
    expect_plane(sampled(3, 0.2, 0, 0.5, quarter, {{"sample.estimator", "lit_fraction"}}), 0.5, "half of it blocks");
    expect_plane(sampled(3, 0.2, 0, 0.5, quarter, {}), 0.25, "A·R, as published");
}

TEST_F(OnALitPlane, NothingComesFromBehindItOrFromSpheresThatDoNotReachIt) {
    for (const char* estimator : {"published", "lit_fraction"}) {
        std::vector<std::pair<std::string, std::string>> sets{{"sample.estimator", estimator}};
        expect_plane(sampled(3, 0.2, 180, 1, plane("1.0"), sets), 0, "seen from behind");
        expect_plane(sampled(3.5, 0.2, 0, 1, plane("1.0"), sets), 0, "half a metre beyond it");
        expect_plane(sampled(2.5, 0.2, 0, 1, plane("1.0"), sets), 0, "half a metre before it");
        expect_plane(sampled(6, 0.2, 0, 1, plane("1.0"), sets), 0, "in another layer");
    }
}

/// Filtered normals are shorter than 1, and darken; normalised_normals undoes just that.
TEST_F(OnALitPlane, NormalisedNormalsDoNotDarken) {
    std::string rough =
        "if (layer == 3) { radiance = vec4(0.7, 0.5, 0.3, 1.0); normal = vec4(0.0, 0.0, -0.6, 1.0); depth = "
        "vec4(0.5, 0.25, 1.0, 0.0); }";
    expect_plane(sampled(3, 0.2, 0, 1, rough, {}), 0.6, "as published");
    expect_plane(sampled(3, 0.2, 0, 1, rough, {{"sample.normalised_normals", "true"}}), 1, "normalised");
}

/// A sphere across a boundary: by its centre alone the other layer is lost.
TEST_F(OnALitPlane, LayersBySphereFindsWhatTheCentresLayerDoesNotHold) {
    double z = 4.3, radius = 1.5; // the plane at 3 m is in layer 1, which ends at 4.2
    expect_plane(sampled(z, radius, 0, 1, plane("1.0"), {{"sample.estimator", "lit_fraction"}}), 0, "by centre");
    expect_plane(sampled(z, radius, 0, 1, plane("1.0"),
                         {{"sample.estimator", "lit_fraction"}, {"sample.layers_by_sphere", "true"}}),
                 1, "by sphere");
}

/// What lies where two layers overlap is in both of them, but counts once.
TEST_F(OnALitPlane, InAnOverlapCountsOnce) {
    // The plane at 4.1 m: at .9583 of layer 1, [1.8, 4.2], and at .09375 of layer 2, [3.8, 7].
    std::string both =
        "if (layer == 3 || layer == 1) { float mu = layer == 3 ? 0.958333 : 0.09375; radiance = vec4(0.7, 0.5, "
        "0.3, 1.0); normal = vec4(0.0, 0.0, -1.0, 1.0); depth = vec4(mu, mu * mu, 1.0, 0.0); }";
    for (const char* by_sphere : {"false", "true"}) {
        expect_plane(sampled(4.1, 0.3, 0, 1, both, {{"sample.layers_by_sphere", by_sphere}}), 1, by_sphere);
        expect_plane(sampled(4.1, 0.3, 0, 1, both,
                             {{"sample.layers_by_sphere", by_sphere}, {"sample.estimator", "lit_fraction"}}),
                     1, by_sphere);
    }
}
