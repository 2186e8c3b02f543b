// An object that slides by an eighth of a voxel a frame: how far the indirect light of a fixed spot of the floor beside
// it jumps, by its second difference from frame to frame over its mean (what changes evenly gives none).
#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 64, k_frames = 18;

class Slide : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, glm::vec3(0.7f))
            .quad({-1, 0, -1}, {1, 0, -1}, {1, 1.4f, -1}, {-1, 1.4f, -1}, {0.7f, 0.3f, 0.2f})
            .write(folder_.path(), "room");
        TinyScene().box({-0.2f, 0.02f, -0.2f}, {0.2f, 0.5f, 0.2f}, {0.8f, 0.8f, 0.8f}).write(folder_.path(), "box");
        float voxel = 2 * (1 + 2.0f / k_resolution) / k_resolution, path = voxel / 8 * (k_frames - 1);
        // The camera sees only floor, to the right of where the box comes to.
        shot_ = write_shot(
            folder_.path(), "slide", "room.gltf", {0.45f, 0.9f, 0.1f}, {0.45f, 0, 0},
            R"({"type":"directional","direction":[-0.6,-0.8,-0.5],"intensity":3})",
            fmt::format(
                R"(,"fps":{},"objects":[{{"scene":"box.gltf","path":[{{"t":0,"position":[-0.2,0,0]}},{{"t":1,"position":[{},0,0]}}]}}])",
                k_frames - 1, -0.2f + path));
    }
    double jump(const std::string& graph, std::vector<std::pair<std::string, std::string>> sets) {
        SessionOptions options;
        options.shot = shot_;
        options.graph = graph;
        options.size = glm::ivec2(24);
        options.sets = std::move(sets);
        options.sets.emplace_back("voxelization.resolution", std::to_string(k_resolution));
        Session session(options);
        std::vector<double> light;
        for (int frame = 0; frame < k_frames; ++frame) {
            if (frame > 0) session.advance();
            session.render();
            std::vector<float> values = session.graph().texture("out.indirect_diffuse")->read();
            double sum = 0;
            for (int y = 8; y < 16; ++y)
                for (int x = 8; x < 16; ++x)
                    sum += values[size_t(4 * (x + 24 * y))];
            light.push_back(sum / 64);
        }
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
        double squares = 0, mean = 0;
        for (double l : light)
            mean += l / double(light.size());
        EXPECT_GT(mean, 1e-4) << graph;
        for (size_t i = 1; i + 1 < light.size(); ++i)
            squares += std::pow(light[i - 1] - 2 * light[i] + light[i + 1], 2);
        return std::sqrt(squares / double(light.size() - 2)) / mean;
    }

  private:
    TempFolder folder_;
    std::string shot_;
};

} // namespace

TEST_F(Slide, OfAnObjectByFractionsOfAVoxel) {
    double published = jump("dvs", {});
    double writer = jump("dvs", {{"voxelization.averaging", "last_writer"}});
    double exact = jump("dvs", {{"voxelization.averaging", "sum"}, {"voxelization.route", "compute"}});
    double tuned = jump("dvs_tuned", {});
    fmt::print("    jumps: dvs {:.4f}, last writer {:.4f}, exact voxels and sums {:.4f}, dvs_tuned {:.4f}\n", published,
               writer, exact, tuned);
    // Twice what was measured. Exact hits see voxels that come and go; wide cones see next to nothing of them.
    EXPECT_LT(published, 0.0042);
    EXPECT_LT(writer, 0.0042);
    EXPECT_LT(exact, 0.014);
    EXPECT_LT(tuned, 0.072);
    EXPECT_GT(tuned, published);
}
