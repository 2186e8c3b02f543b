// Bands that wide cones draw on an even floor, against the step β: the second difference from pixel to pixel of the
// gathered light, less that of a very fine step, over the mean. Dithered starts trade them for noise, which a mean over
// 4 × 4 pixels takes away.
#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace bounce;

namespace {

constexpr int k_width = 96, k_height = 64;

class Banding : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        TinyScene scene;
        scene.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, glm::vec3(0.7f));
        scene.quad({-1, 0, -1}, {1, 0, -1}, {1, 1.5f, -1}, {-1, 1.5f, -1}, glm::vec3(0.7f));
        scene.write(folder_.path(), "corner");
        // The sun grazes the floor and lights the wall; the camera sees the floor alone, from above.
        shot_ = write_shot(folder_.path(), "corner", "corner.gltf", {0, 1.4f, 0.1f}, {0, 0, 0.0f},
                           R"({"type":"directional","direction":[0,-0.02,-1],"intensity":3})");
    }
    /// Red of out.indirect_diffuse.
    std::vector<double> picture(double step, bool dithered) {
        SessionOptions options;
        options.shot = shot_;
        options.graph = "vct";
        options.size = glm::ivec2(k_width, k_height);
        options.sets = {{"voxelization.resolution", "64"},
                        {"voxelization.averaging", "sum"},
                        {"gather.max_steps", "512"},
                        {"gather.cone_step", fmt::format("{}", step)},
                        {"gather.dithered_start", dithered ? "true" : "false"}};
        Session session(options);
        session.render();
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
        std::vector<float> values = session.graph().texture("out.indirect_diffuse")->read();
        std::vector<double> red;
        for (size_t i = 0; i < values.size(); i += 4)
            red.push_back(values[i]);
        return red;
    }
    /// RMS over all columns of the second difference along them, of what `a` has more than `b`, over the mean of b.
    static double bands(const std::vector<double>& a, const std::vector<double>& b) {
        double squares = 0, mean = 0;
        int count = 0;
        auto d = [&](int x, int y) { return a[size_t(x + k_width * y)] - b[size_t(x + k_width * y)]; };
        for (int y = 12; y + 13 < k_height; ++y)
            for (int x = 12; x + 13 < k_width; ++x) {
                squares += std::pow(d(x, y - 1) - 2 * d(x, y) + d(x, y + 1), 2);
                mean += b[size_t(x + k_width * y)];
                ++count;
            }
        return std::sqrt(squares / count) / (mean / count);
    }
    /// Means of 4 × 4 pixels around each.
    static std::vector<double> smooth(const std::vector<double>& a) {
        std::vector<double> out(a.size());
        for (int y = 2; y + 2 <= k_height; ++y)
            for (int x = 2; x + 2 <= k_width; ++x) {
                double sum = 0;
                for (int k = 0; k < 16; ++k)
                    sum += a[size_t(x - 2 + k % 4 + k_width * (y - 2 + k / 4))];
                out[size_t(x + k_width * y)] = sum / 16;
            }
        return out;
    }

  private:
    TempFolder folder_;
    std::string shot_;
};

} // namespace

TEST_F(Banding, GrowsWithTheStepAndDithersAway) {
    std::vector<double> fine = picture(0.05, false), fine_smooth = smooth(fine);
    double before = 0;
    for (double step : {0.25, 0.5, 1.0}) {
        std::vector<double> plain = picture(step, false), dithered = picture(step, true);
        double plain_bands = bands(plain, fine), plain_smooth = bands(smooth(plain), fine_smooth);
        double dithered_noise = bands(dithered, fine), dithered_smooth = bands(smooth(dithered), fine_smooth);
        fmt::print("    step {:<4} bands {:.4f}, in means of 4 x 4 {:.5f}; dithered {:.4f} and {:.5f}\n", step,
                   plain_bands, plain_smooth, dithered_noise, dithered_smooth);
        EXPECT_GT(plain_bands, 1.5 * before) << "step " << step;
        EXPECT_GT(dithered_noise, 1.5 * plain_bands) << "step " << step;
        EXPECT_LT(dithered_smooth, 0.98 * plain_smooth) << "step " << step;
        before = plain_bands;
    }
}
