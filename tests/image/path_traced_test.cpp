// The graph path_traced takes the reference's samples: with as many of them its pictures are the same but for rounding,
// and, where rounding turns a path elsewhere, the same in mean.
#include "app/session.h"
#include "reference/integrator.h"
#include "support/gpu_context.h"

#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

struct PathCase {
    const char* name;
    const char* shot;
    int bounces;
    bool diffuse_only;
    int samples;
    double most;        ///< relative RMSE of a part, or of its mean's error where paths may turn elsewhere
    bool means = false; ///< only means are compared
    /// In both frames together, as far as they add up.
    int kept() const { return moves ? samples / 2 : samples; }
    bool moves = false; ///< the second frame starts anew
    bool diffuse_secondary = false;
};

void PrintTo(const PathCase& path_case, std::ostream* out) {
    *out << path_case.name;
}

class PathTraced : public GpuTest, public testing::WithParamInterface<PathCase> {};

constexpr glm::ivec2 k_size(40, 30);

/// The reference's samples 0 … count − 1 of every pixel: all channels' means.
std::vector<PixelSample> reference_means(const PathCase& path_case, const Shot& shot) {
    ReferenceSettings settings;
    settings.bounces = path_case.bounces;
    settings.diffuse_only = path_case.diffuse_only;
    settings.diffuse_secondary = path_case.diffuse_secondary;
    const TraceScene scene(shot, evaluate_shot(shot, path_case.moves ? 1 : 0), settings);
    Integrator integrator(scene);
    std::vector<PixelSample> means;
    for (int y = 0; y < k_size.y; ++y) {
        for (int x = 0; x < k_size.x; ++x) {
            std::vector<PixelSampler> samplers;
            for (int i = 0; i < path_case.kept(); ++i) {
                const uint32_t half = hash_combine(0, uint32_t(i & 1));
                samplers.emplace_back(hash_combine(hash_combine(half, uint32_t(x)), uint32_t(y)), uint32_t(i >> 1),
                                      true);
            }
            std::vector<PixelSample> samples(samplers.size());
            integrator.sample(x, y, samplers, samples);
            PixelSample& mean = means.emplace_back();
            mean.fill(0);
            for (const PixelSample& sample : samples)
                for (size_t c = 0; c < mean.size(); ++c)
                    mean[c] += sample[c] / float(samples.size());
        }
    }
    return means;
}

} // namespace

TEST_P(PathTraced, TakesTheReferencesSamples) {
    const PathCase& path_case = GetParam();
    SessionOptions options;
    options.shot = path_case.shot;
    options.graph = "path_traced";
    options.size = k_size;
    options.sets = {{"path.bounces", std::to_string(path_case.bounces)},
                    {"path.samples", std::to_string(path_case.samples / 2)},
                    {"path.microfacets", path_case.diffuse_only ? "false" : "true"},
                    {"path.glossy_secondary", path_case.diffuse_secondary ? "false" : "true"}};
    Session session(options);
    session.render();
    session.advance(); // what two frames took adds up
    session.render();
    Shot shot = load_shot(path_case.shot);
    shot.width = k_size.x, shot.height = k_size.y;
    const std::vector<PixelSample> expected = reference_means(path_case, shot);
    for (int part = 0; part < k_radiance_parts; ++part) {
        const ReferencePart& known = k_reference_parts[size_t(part)];
        const std::vector<float> found = session.graph().texture(std::string(known.name))->read();
        double sum = 0, other = 0, squares = 0, spread = 0;
        for (size_t i = 0; i < expected.size(); ++i) {
            if (part < 5) {
                EXPECT_EQ(found[4 * i + 3], float(path_case.kept()));
            }
            for (size_t c = 0; c < 3; ++c) {
                const double a = found[4 * i + c], b = expected[i][size_t(known.offset) + c];
                sum += b, other += a, squares += (a - b) * (a - b), spread += b * b;
            }
        }
        const double count = 3 * double(expected.size());
        const double mean = sum / count, rmse = std::sqrt(squares / count), deviation = std::sqrt(spread / count);
        if (!(mean > 0)) {
            EXPECT_EQ(other, 0) << known.name;
            continue;
        }
        fmt::print("    {:<16} {:<22} mean {:+.3f} %, pixels {:.3f} %\n", path_case.name, known.name,
                   100 * (other / sum - 1), 100 * rmse / mean);
        if (path_case.means) // within what so many pixels with this spread can tell, all paths being others
            EXPECT_NEAR(other / sum, 1, std::max(path_case.most, 3 * rmse / mean / std::sqrt(count / 3))) << known.name;
        else
            EXPECT_LT(rmse, path_case.most * deviation) << known.name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Of, PathTraced,
    testing::Values(PathCase{"cornell_direct", "cornell", 0, false, 8, 1e-3},
                    PathCase{"cornell_1", "cornell", 1, false, 8, 1e-3},
                    PathCase{"cornell_diffuse_2", "cornell", 2, true, 8, 1e-3},
                    PathCase{"cornell_secondary_2", "cornell", 2, false, 8, 1e-3, false, false, true},
                    PathCase{"cornell_8", "cornell", 8, false, 8, 1e-3},
                    PathCase{"cornell_all", "cornell", -1, false, 4, 1e-3},
                    PathCase{"lamp_direct", "cornell_lamp", 0, false, 8, 1e-3},
                    PathCase{"lamp_8", "cornell_lamp", 8, false, 8, 1e-3},
                    PathCase{"animated_2", "animated", 2, false, 8, 5e-3, false, true},
                    PathCase{"gallery_2", "gallery", 2, false, 8, 2e-3, true},
                    PathCase{"gallery_secondary_2", "gallery", 2, false, 8, 2e-3, true, false, true},
                    PathCase{"atrium_2", "atrium", 2, false, 16, 2e-3, true},
                    PathCase{"hairball_1", "hairball", 1, false, 8, 2e-3, true}),
    [](const auto& path_case) { return std::string(path_case.param.name); });
