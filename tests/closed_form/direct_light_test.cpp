// Direct light against its closed form, rho/pi · I · cosθ / d² · falloff, and against rays for who sees the light.

#include "app/session.h"
#include "closed_form/oracle.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr double k_texels_from_rim = 2;
constexpr double k_smallest_normal_half = 6.104e-5;

struct Comparison {
    int lit = 0, shadowed = 0, unlit = 0, edge = 0, background = 0;
    int light_leaks = 0;   ///< lit where a ray says shadowed
    int false_shadows = 0; ///< dark where a ray says lit
    double worst = 0, sum = 0;
    std::string worst_at;
    double mean() const { return lit ? sum / lit : 0; }
};

class DirectLight : public GpuTest {
  protected:
    /// Renders `shot` and compares out.direct of its one light, pixel by pixel.
    Comparison compare(const std::string& shot, glm::ivec2 size, int shadow_resolution) {
        SessionOptions options;
        options.shot = shot;
        options.size = size;
        options.sets = {{"shadow_maps.resolution", std::to_string(shadow_resolution)}};
        Session session(options);
        session.render();
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
        std::vector<float> got = session.graph().texture("out.direct")->read();
        DirectOracle oracle(session.shot(), size, shadow_resolution);
        EXPECT_EQ(oracle.lights().size(), 1u);
        const Light& light = oracle.lights().front();

        Comparison result;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                OraclePixel expected = oracle.pixel(x, y, light, k_texels_from_rim);
                const float* rgb = &got[4 * (size_t(y) * size_t(size.x) + size_t(x))];
                judge(expected, rgb, x, y, result);
            }
        }
        RecordProperty("max_relative_error", fmt::format("{:.6f}", result.worst));
        fmt::print(
            "    {:<28} {:>4}² map: {} lit, {} shadowed, {} unlit, {} at edges; error max {:.4f} %, mean {:.4f} %; "
            "{} leaks, {} false shadows\n",
            std::filesystem::path(shot).stem().string(), shadow_resolution, result.lit, result.shadowed, result.unlit,
            result.edge, 100 * result.worst, 100 * result.mean(), result.light_leaks, result.false_shadows);
        return result;
    }

    void expect_exact(const Comparison& result, double most_at_edges) {
        EXPECT_LT(result.worst, 0.005) << result.worst_at;
        EXPECT_EQ(result.light_leaks, 0) << result.worst_at;
        EXPECT_EQ(result.false_shadows, 0) << result.worst_at;
        EXPECT_GT(result.lit, 100);
        EXPECT_LT(result.edge, most_at_edges * (result.lit + result.shadowed + result.unlit + result.edge));
    }

  private:
    static void judge(const OraclePixel& expected, const float* rgb, int x, int y, Comparison& result) {
        using Kind = OraclePixel::Kind;
        double sum = rgb[0] + rgb[1] + rgb[2];
        switch (expected.kind) {
        case Kind::background:
            ++result.background;
            EXPECT_EQ(sum, 0) << "background at " << x << ", " << y;
            break;
        case Kind::edge:
            ++result.edge;
            break;
        case Kind::unlit:
            ++result.unlit;
            EXPECT_EQ(sum, 0) << "light from behind at " << x << ", " << y;
            break;
        case Kind::shadowed:
            ++result.shadowed;
            if (sum > 0) {
                ++result.light_leaks;
                result.worst_at = fmt::format("leak at {}, {}", x, y);
            }
            break;
        case Kind::lit:
            // Where the light all but vanishes at a spot's rim, half floats have no relative precision left.
            if (std::max({expected.radiance.r, expected.radiance.g, expected.radiance.b}) < k_smallest_normal_half)
                break;
            if (sum == 0) {
                ++result.false_shadows;
                result.worst_at = fmt::format("false shadow at {}, {} (cosine {:.3f})", x, y, expected.cosine);
                break;
            }
            ++result.lit;
            double error = 0;
            for (int c = 0; c < 3; ++c)
                if (expected.radiance[c] >= k_smallest_normal_half)
                    error = std::max(error, std::abs(rgb[c] / expected.radiance[c] - 1));
            result.sum += error;
            if (error > result.worst) {
                result.worst = error;
                result.worst_at = fmt::format("error at {}, {} (cosine {:.3f})", x, y, expected.cosine);
            }
            break;
        }
    }
};

const char* const k_spot =
    R"({"type":"spot","position":[0.3,3,0.2],"direction":[-0.1,-1,0.1],"intensity":[9,6,3],"inner_cone_deg":20,"outer_cone_deg":42})";
const char* const k_point = R"({"type":"point","position":[0.9,1.6,0.7],"intensity":[3,4,5]})";
const char* const k_sun = R"({"type":"directional","direction":[-0.5,-1,-0.3],"intensity":[2,2,1]})";

TinyScene plane_alone() {
    return TinyScene().quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, {0.8f, 0.4f, 0.2f});
}

/// A floor, a floating slab over it, a block on it, and a tilted board: contact, distance and slopes.
TinyScene plane_and_blocks() {
    return plane_alone()
        .box({-0.9f, 0.7f, -0.6f}, {-0.2f, 0.75f, 0.5f}, {0.2f, 0.6f, 0.4f})
        .box({0.3f, 0, -0.9f}, {0.8f, 0.5f, -0.4f}, {0.3f, 0.3f, 0.7f})
        .quad({-1.2f, 0.1f, 1.2f}, {0.1f, 0.2f, 1.4f}, {0.1f, 0.9f, 0.9f}, {-1.2f, 0.8f, 0.7f}, {0.7f, 0.7f, 0.1f});
}

class OneLight : public DirectLight, public testing::WithParamInterface<std::pair<const char*, const char*>> {};

} // namespace

TEST_P(OneLight, OnABarePlaneIsExact) {
    TempFolder folder;
    plane_alone().write(folder.path(), "plane");
    std::string shot = write_shot(folder.path(), std::string("plane_") + GetParam().first, "plane.gltf", {0, 3, 3.5f},
                                  {0, 0, 0}, GetParam().second);
    Comparison result = compare(shot, {64, 64}, 128);
    expect_exact(result, 0.1);
    EXPECT_EQ(result.shadowed, 0);
}

TEST_P(OneLight, AmongBlocksIsExactAwayFromShadowEdges) {
    TempFolder folder;
    plane_and_blocks().write(folder.path(), "blocks");
    std::string shot = write_shot(folder.path(), std::string("blocks_") + GetParam().first, "blocks.gltf",
                                  {0.4f, 2.6f, 3.2f}, {0, 0.1f, 0}, GetParam().second);
    for (int resolution : {128, 512, 1024}) {
        Comparison result = compare(shot, {96, 96}, resolution);
        expect_exact(result, resolution < 512 ? 0.55 : 0.25);
        EXPECT_GT(result.shadowed, resolution < 512 ? 20 : 80);
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, OneLight,
                         testing::Values(std::pair{"spot", k_spot}, std::pair{"point", k_point},
                                         std::pair{"directional", k_sun}),
                         [](auto& test) { return test.param.first; });

/// Faces that look straight at a light that stands off a shadow map's axis: the map's texels lie aslant on them all the
/// same.
TEST_F(DirectLight, FacesTurnedTowardAPointLightFromTheCornerOfItsCubeAreLit) {
    TempFolder folder;
    glm::vec3 n = glm::normalize(glm::vec3(1, 1, 1)), u = glm::normalize(glm::vec3(1, -1, 0)), v = glm::cross(n, u);
    auto at = [&](float x, float y) { return -1.5f * n + x * u + y * v; };
    TinyScene().quad(at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)).write(folder.path(), "corner");
    std::string shot = write_shot(folder.path(), "corner", "corner.gltf", 2.0f * n + 0.2f * u, -1.5f * n,
                                  R"({"type":"point","position":[0,0,0],"intensity":8})");
    for (int resolution : {64, 256}) {
        Comparison result = compare(shot, {64, 64}, resolution);
        expect_exact(result, 0.1);
    }
}

TEST_F(DirectLight, OfAWideSpotIsExactToItsRim) {
    TempFolder folder;
    plane_and_blocks().write(folder.path(), "blocks");
    std::string shot = write_shot(folder.path(), "wide_spot", "blocks.gltf", {0.4f, 2.6f, 3.2f}, {0, 0.1f, 0},
                                  R"({"type":"spot","position":[-0.6,1.4,0.1],"direction":[0.1,-1,0],"intensity":5,)"
                                  R"("inner_cone_deg":10,"outer_cone_deg":75})");
    Comparison result = compare(shot, {96, 96}, 1024);
    expect_exact(result, 0.4);
}

TEST_F(DirectLight, OnCornellIsExactAwayFromShadowEdges) {
    TempFolder folder;
    std::string spot = write_shot(folder.path(), "cornell_spot", "cornell.gltf", {2.78f, 2.73f, -8}, {2.78f, 2.73f, 0},
                                  R"({"type":"spot","position":[2.78,5.468,2.795],"direction":[0,-1,0],"intensity":75,)"
                                  R"("inner_cone_deg":45,"outer_cone_deg":60})",
                                  R"(,"environment":0)");
    expect_exact(compare(spot, {96, 96}, 512), 0.35);
    expect_exact(compare(spot, {96, 96}, 2048), 0.15);
    std::string point = write_shot(folder.path(), "cornell_point", "cornell.gltf", {2.78f, 2.73f, -8},
                                   {2.78f, 2.73f, 0}, R"({"type":"point","position":[1.2,4.4,1.5],"intensity":20})");
    expect_exact(compare(point, {96, 96}, 1024), 0.35);
    std::string sun = write_shot(folder.path(), "cornell_sun", "cornell.gltf", {2.78f, 2.73f, -8}, {2.78f, 2.73f, 0},
                                 R"({"type":"directional","direction":[0.4,-0.6,1],"intensity":3})");
    expect_exact(compare(sun, {96, 96}, 1024), 0.35);
}

/// METHODS: every length is a share of the scene's, so s times the scene under s² times the intensity is the same
/// picture.
TEST_F(DirectLight, DoesNotDependOnTheScenesScale) {
    TempFolder folder;
    std::vector<std::vector<float>> pictures;
    for (float s : {1.0f, 0.01f, 100.0f}) {
        std::string name = fmt::format("scaled_{}", s);
        plane_and_blocks().scaled(s).write(folder.path(), name);
        std::string lights = fmt::format(
            R"({{"type":"spot","position":[{},{},{}],"direction":[-0.1,-1,0.1],"intensity":{},"inner_cone_deg":20,"outer_cone_deg":42}},)"
            R"({{"type":"point","position":[{},{},{}],"intensity":{}}},{})",
            0.3f * s, 3 * s, 0.2f * s, 9 * s * s, 0.9f * s, 1.6f * s, 0.7f * s, 4 * s * s, k_sun);
        SessionOptions options;
        options.shot = write_shot(folder.path(), name, name + ".gltf", s * glm::vec3(0.4f, 2.6f, 3.2f),
                                  s * glm::vec3(0, 0.1f, 0), lights);
        options.size = {96, 96};
        options.sets = {{"shadow_maps.resolution", "256"}};
        Session session(options);
        session.render();
        pictures.push_back(session.graph().texture("out.direct")->read());
    }
    for (size_t scale : {1, 2}) {
        int different = 0;
        double worst = 0;
        for (size_t i = 0; i < pictures[0].size(); i += 4) {
            for (size_t c = 0; c < 3; ++c) {
                double a = pictures[0][i + c], b = pictures[scale][i + c];
                double error = std::abs(a - b) / std::max(1e-3, std::max(a, b));
                worst = std::max(worst, error);
                if (error > 0.005) {
                    ++different;
                    break;
                }
            }
        }
        fmt::print("    scale {}: {} of {} pixels differ by more than 0.5 %, worst {:.4f}\n",
                   scale == 1 ? "×0.01" : "×100", different, pictures[0].size() / 4, worst);
        // Rounding may move a texel's edge across a pixel's centre here and there.
        EXPECT_LE(different, int(pictures[0].size() / 4 / 500));
    }
}
