// The render as an instrument: the same bytes however it is run, noise that is what it says, and no bias.

#include "core/error.h"
#include "reference/render.h"
#include "scenes.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

using namespace bounce;
using namespace bounce::test;
namespace fs = std::filesystem;

namespace {

/// A room with a window of sky, a lamp, glossy and matte things, soft and hard lights: every kind of path.
Shot busy_room() {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    maker.shot.material_model = MaterialModel::plain;
    maker.shot.width = 40;
    maker.shot.height = 24;
    const int white = maker.material(glm::vec3(0.7f)), red = maker.material({0.8f, 0.1f, 0.1f}, glm::vec3(0), 0, 0.4f);
    const int metal = maker.material({0.9f, 0.7f, 0.3f}, glm::vec3(0), 1, 0.25f);
    const int lamp = maker.material(glm::vec3(0.5f), {4, 3, 2});
    maker.quad({-2, 0, -2}, {4, 0, 0}, {0, 0, 4}, red);
    maker.quad({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, white);
    maker.quad({-2, 0, -2}, {0, 0, 4}, {0, 3, 0}, white);
    maker.quad({-0.4f, 2.9f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, lamp);
    maker.box({-1.2f, 0, -1.2f}, {-0.2f, 1.4f, -0.3f}, metal);
    maker.box({0.4f, 0, -0.6f}, {1.2f, 0.7f, 0.5f}, white);
    maker.light(LightType::spot, {1.5f, 2.5f, 1.5f}, {-1, -1.5f, -1}, 6, 0.2f, 0.6f);
    maker.light(LightType::point, {-1.5f, 2, 1}, {0, -1, 0}, 2, 0, 0.7f, 0.1f);
    maker.shot.environment.radiance = glm::vec3(0.5f);
    maker.shot.environment.map = Image(16, 8, 3);
    for (size_t i = 0; i < maker.shot.environment.map.pixels.size(); ++i) {
        maker.shot.environment.map.pixels[i] = float((i * 37) % 11) / 5;
    }
    maker.camera({2.5f, 2, 4}, {0, 0.9f, 0}, 45);
    return maker.shot;
}

bool same_bytes(const ReferenceRender& a, const ReferenceRender& b) {
    const LayeredImage x = a.image(), y = b.image();
    if (x.layers.size() != y.layers.size() || x.metadata != y.metadata) return false;
    for (const auto& [name, layer] : x.layers) {
        if (layer.pixels != y.layers.at(name).pixels) return false;
    }
    return true;
}

double mean(const Image& image) {
    return image_mean(image, Mask(image.width, image.height));
}

class StateFiles : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "bounce-state-XXXXXX").string();
        folder = mkdtemp(pattern.data());
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

} // namespace

TEST(Render, TheNumberOfThreadsDoesNotShow) {
    const Shot shot = busy_room();
    ReferenceSettings settings;
    settings.threads = 1;
    ReferenceRender one(shot, settings);
    one.render_to(9);
    for (int threads : {2, 5}) {
        settings.threads = threads;
        ReferenceRender many(shot, settings);
        many.render_to(9);
        EXPECT_TRUE(same_bytes(one, many)) << threads;
    }
}

TEST(Render, StepsAndSeedsAreWhatTheySay) {
    const Shot shot = busy_room();
    ReferenceRender whole(shot, {}), steps(shot, {});
    whole.render_to(7);
    for (int count : {1, 3, 2, 1})
        EXPECT_TRUE(steps.step(count));
    EXPECT_EQ(steps.samples(), 7);
    EXPECT_TRUE(same_bytes(whole, steps));
    ReferenceSettings other;
    other.seed = 1;
    ReferenceRender different(shot, other);
    different.render_to(7);
    EXPECT_NE(different.part("out.radiance").pixels, whole.part("out.radiance").pixels);
    EXPECT_NE(different.key(), whole.key());
}

TEST_F(StateFiles, AnInterruptedRenderResumesToTheSameBytes) {
    Shot shot = busy_room();
    ReferenceRender whole(shot, {});
    whole.render_to(24);

    ReferenceRender first(shot, {});
    std::thread stopper([&] {
        while (first.progress() >= 1 || first.progress() < 0.2)
            std::this_thread::yield();
        first.cancel();
    });
    bool finished = first.render_to(24);
    stopper.join();
    EXPECT_EQ(finished, first.samples() == 24);
    first.save_state(folder / "a.state");

    ReferenceRender second(shot, {});
    second.load_state(folder / "a.state");
    EXPECT_EQ(second.samples(), first.samples());
    EXPECT_EQ(second.max_samples(), first.max_samples());
    EXPECT_TRUE(second.render_to(24));
    EXPECT_TRUE(same_bytes(whole, second));
}

TEST_F(StateFiles, AStateOfAnotherShotOrADamagedOneIsRefused) {
    Shot shot = busy_room();
    ReferenceRender render(shot, {});
    render.render_to(2);
    render.save_state(folder / "a.state");
    shot.scene.materials[0].base_colour.r = 0.71f;
    ReferenceRender other(shot, {});
    EXPECT_NE(other.key(), render.key());
    auto message = [&](const fs::path& path) -> std::string {
        try {
            other.load_state(path);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(message(folder / "a.state"), testing::HasSubstr("another shot"));
    const std::string bytes = read_file(folder / "a.state");
    for (size_t length : {size_t(0), size_t(10), size_t(40), size_t(500), bytes.size() - 1}) {
        write_file_atomically(folder / "b.state", bytes.substr(0, length));
        EXPECT_THAT(message(folder / "b.state"), testing::HasSubstr("b.state")) << length;
    }
    EXPECT_EQ(other.samples(), 0);
    if (fs::exists("/dev/full")) {
        EXPECT_THROW(render.save_state("/dev/full"), Error);
    }
}

TEST(Render, CancellingKeepsWhatIsDone) {
    const Shot shot = busy_room();
    ReferenceRender render(shot, {});
    render.render_to(4);
    render.cancel();
    EXPECT_FALSE(render.render_to(1000));
    EXPECT_GE(render.samples(), 4);
    EXPECT_LT(render.samples(), 1000);
    EXPECT_TRUE(render.render_to(render.max_samples() + 1));
}

TEST(Render, PartsAddUpAndAreNamed) {
    ReferenceRender render(busy_room(), {});
    render.render_to(8);
    const LayeredImage image = render.image();
    for (const char* name : {"out.direct", "out.emitted", "out.environment", "out.indirect_diffuse",
                             "out.indirect_specular", "out.emission", "out.radiance"}) {
        ASSERT_TRUE(image.layers.count(name)) << name;
        EXPECT_GT(mean(image.layers.at(name)), 0) << name;
    }
    const auto& l = image.layers;
    for (size_t i = 0; i < l.at("out.radiance").pixels.size(); ++i) {
        const float sum = l.at("out.direct").pixels[i] + l.at("out.emitted").pixels[i] +
                          l.at("out.environment").pixels[i] + l.at("out.indirect_diffuse").pixels[i] +
                          l.at("out.indirect_specular").pixels[i] + l.at("out.emission").pixels[i];
        ASSERT_NEAR(l.at("out.radiance").pixels[i], sum, 1e-5f * (1 + sum));
    }
    EXPECT_THROW(render.part("out.indirect_difuse"), Error);
    EXPECT_THAT(image.metadata, testing::HasSubstr("\"relative_off_edges\""));
}

// Means of independent seeds scatter as the half-images of one of them predict.
TEST(Render, IndependentSeedsDifferAsTheirNoisePredicts) {
    const Shot shot = busy_room();
    const int seeds = 12, samples = 16;
    const double pixels = double(shot.width) * shot.height;
    for (const char* name : {"out.radiance", "out.indirect_diffuse", "out.ambient_occlusion"}) {
        std::vector<double> means;
        double predicted = 0; // variance of an image mean
        for (int seed = 0; seed < seeds; ++seed) {
            ReferenceSettings settings;
            settings.seed = unsigned(seed) + 100;
            ReferenceRender render(shot, settings);
            render.render_to(samples);
            // Channels of a pixel share their samples: count them as one.
            const Image part = render.part(name), a = render.half(name, 0), b = render.half(name, 1);
            means.push_back(mean(part));
            double variance = 0;
            for (size_t i = 0; i < part.pixels.size(); i += size_t(part.channels)) {
                double d = 0;
                for (int c = 0; c < part.channels; ++c) {
                    d += 0.5 * (double(a.pixels[i + size_t(c)]) - b.pixels[i + size_t(c)]) / part.channels;
                }
                variance += d * d;
            }
            predicted += variance / (pixels * pixels) / seeds;
        }
        double average = 0, scatter = 0;
        for (double m : means)
            average += m / seeds;
        for (double m : means)
            scatter += (m - average) * (m - average) / (seeds - 1);
        // The ratio is χ² over its 11 degrees of freedom: 0.1 % quantiles 0.14 and 2.84.
        EXPECT_GT(scatter / predicted, 0.14) << name;
        EXPECT_LT(scatter / predicted, 2.84) << name;
    }
}

TEST(Render, HalvingTheNoiseCostsFourTimesTheSamples) {
    const Shot shot = busy_room();
    for (bool stratified : {false, true}) {
        for (const char* name : {"out.indirect_diffuse", "out.ambient_occlusion"}) {
            double before = 0, after = 0; // variances, over some seeds since paths have long tails
            for (unsigned seed = 0; seed < 4; ++seed) {
                ReferenceSettings settings;
                settings.stratified = stratified;
                settings.seed = seed;
                settings.bounces = 1;
                ReferenceRender render(shot, settings);
                render.render_to(16);
                before += std::pow(render.noise(name).rms, 2);
                render.render_to(64);
                after += std::pow(render.noise(name).rms, 2);
            }
            // Independent samples: exactly ½ on average. Stratified ones do at least as well.
            const double ratio = std::sqrt(after / before);
            EXPECT_GT(ratio, stratified ? 0.2 : 0.45) << name;
            EXPECT_LT(ratio, 0.55) << name;
        }
    }
}

// The noise estimate is the error against a much better image.
TEST(Render, NoiseIsTheErrorAgainstTheTruth) {
    const Shot shot = busy_room();
    ReferenceRender rough(shot, {}), fine(shot, {});
    ReferenceSettings other;
    other.seed = 5;
    ReferenceRender good(shot, other);
    rough.render_to(16);
    good.render_to(400);
    const Mask all(shot.width, shot.height);
    for (const char* name : {"out.radiance", "out.indirect_diffuse"}) {
        const ErrorFigures figures = error_figures(rough.part(name), good.part(name), all, good.noise(name).rms);
        const double estimate = rough.noise(name).rms;
        EXPECT_NEAR(figures.relative_rmse_denoised * figures.reference_mean / estimate, 1, 0.2) << name;
    }
}

// A scene scaled by s with intensities scaled by s² is the same picture.
TEST(Render, ScaleDoesNotShow) {
    for (float s : {0.01f, 100.0f}) {
        Shot shot = busy_room();
        ReferenceRender one(shot, {});
        for (Vertex& vertex : shot.scene.vertices)
            vertex.position *= s;
        for (Node& node : shot.scene.nodes)
            node.translation *= s;
        for (Light& light : shot.scene.lights) {
            light.position *= s;
            light.intensity *= s * s;
            light.radius *= s;
        }
        shot.camera.position *= s;
        shot.camera.target *= s;
        ReferenceRender scaled(shot, {});
        one.render_to(32);
        scaled.render_to(32);
        EXPECT_NEAR(mean(scaled.part("out.radiance")) / mean(one.part("out.radiance")), 1, 2e-3) << s;
        EXPECT_NEAR(mean(scaled.part("out.ambient_occlusion_dmax")) / mean(one.part("out.ambient_occlusion_dmax")), 1,
                    2e-3);
    }
}

TEST(Render, BadSettingsAreErrors) {
    Shot shot = busy_room();
    ReferenceSettings settings;
    settings.bounces = -2;
    EXPECT_THROW(ReferenceRender(shot, settings), Error);
    shot.width = 0;
    EXPECT_THROW(ReferenceRender(shot, {}), Error);
}
