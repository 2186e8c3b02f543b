// The Compare panel: a reference in the background, what the viewport shows of the pair, live figures and points.
#include "app/panel_fixture.h"
#include "app/ui/live_comparison.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

namespace bounce {
namespace {

class ComparePanel : public PanelsTest {
  protected:
    void start(float noise) {
        show(draw_compare_panel);
        comparison().noise = noise;
        click("compare.start");
    }
    /// Frames until `done`, for at most half a minute.
    template <class Done>
    bool frames_until(Done&& done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!done() && std::chrono::steady_clock::now() < end) {
            frame();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return done();
    }
    void compare() {
        start(0.2f);
        ASSERT_TRUE(frames_until([&] { return !comparison().running() && comparison().measured(); }))
            << comparison().problem();
        frame();
    }
    LiveComparison& comparison() { return *ui.comparison; }
    std::vector<float> picture(double seconds = 0) {
        const GpuTexture* texture = comparison().picture(*session, seconds);
        return texture ? texture->read() : std::vector<float>();
    }
    /// The share of pixels of the columns from … to − 1 that show the graph's own sum of what is compared, toned as the
    /// graph tones its picture.
    double share_of_own(const std::vector<float>& shown, int from, int to) {
        std::vector<float> sum = session->graph().texture("out.direct")->read();
        if (const GpuTexture* emission = session->graph().texture("out.emission")) { // where something emits
            const std::vector<float> more = emission->read();
            std::transform(sum.begin(), sum.end(), more.begin(), sum.begin(), std::plus<>());
        }
        const float scale = session->value_scale("out.direct");
        const int width = session->size().x;
        int same = 0, all = 0;
        for (int y = 0; y < session->size().y; ++y) {
            for (int x = from; x < to; ++x, ++all) {
                const size_t i = 4 * size_t(y * width + x);
                bool equal = true;
                for (size_t c = i; c < i + 3; ++c) {
                    const float own = srgb_encode(std::clamp(scale * sum[c], 0.0f, 1.0f));
                    equal = equal && std::abs(shown[c] - own) < 0.6f / 255;
                }
                same += equal;
            }
        }
        return double(same) / all;
    }
};

TEST_F(ComparePanel, RendersTheReferenceAndTellsTheError) {
    compare();
    EXPECT_EQ(comparison().problem(), "");
    EXPECT_GE(comparison().samples(), 8);
    const double error = comparison().figures()["relative_rmse"];
    EXPECT_LT(std::abs(comparison().figures()["bias"]), 0.05);
    // A worse picture is told at once, without another reference.
    session->set_parameter("direct.normal_offset", "16", ParameterOrigin::panel);
    session->set_parameter("shadow_maps.resolution", "64", ParameterOrigin::panel);
    session->render();
    frame();
    EXPECT_GT(comparison().figures()["relative_rmse"], 1.2 * error);
    EXPECT_FALSE(comparison().running());
}

TEST_F(ComparePanel, ShowsThePairInFourWays) {
    compare();
    EXPECT_TRUE(picture().empty()) << "off: the graph's picture is shown as it is";
    const int width = session->size().x;
    click("compare.view.split");
    EXPECT_EQ(comparison().view, CompareView::split);
    EXPECT_EQ(share_of_own(picture(), 0, width / 2), 1);
    EXPECT_LT(share_of_own(picture(), width / 2, width), 0.9);
    drag("compare.split", 0.3f, 0.05f);
    EXPECT_LT(comparison().split, 0.2f);
    EXPECT_LT(share_of_own(picture(), width / 4, width), 0.9);
    click("compare.view.flicker");
    EXPECT_EQ(share_of_own(picture(0.2), 0, width), 1);
    EXPECT_LT(share_of_own(picture(0.7), 0, width), 0.9);
    const std::vector<float> truth = picture(0.7);
    click("compare.view.reference");
    EXPECT_EQ(picture(), truth);
    click("compare.view.error");
    EXPECT_NE(picture(), truth);
    EXPECT_FALSE(picture().empty());
}

TEST_F(ComparePanel, TheViewSaysWhatItCompares) {
    compare();
    click("compare.view.split");
    session->set_parameter("tonemap.exposure", "-2", ParameterOrigin::panel);
    session->set_parameter("tonemap.curve", "aces_like", ParameterOrigin::panel);
    session->render();
    frame();
    EXPECT_EQ(comparison().caption(*session, 0), "graph | reference: direct + emission, exposure -2, curve aces_like");
    click("compare.view.flicker");
    EXPECT_THAT(comparison().caption(*session, 0.2), testing::StartsWith("graph: direct + emission"));
    EXPECT_THAT(comparison().caption(*session, 0.7), testing::StartsWith("reference: direct + emission"));
    click("compare.view.error");
    EXPECT_EQ(comparison().caption(*session, 0), "relative error of direct + emission, 0 to 50 %");
}

TEST_F(ComparePanel, AnotherViewNeedsAnotherReference) {
    compare();
    click("compare.view.reference");
    Camera camera = session->camera();
    camera.position.x += 0.5f;
    session->set_camera(camera);
    session->render();
    frame();
    EXPECT_TRUE(comparison().stale(*session));
    EXPECT_EQ(comparison().picture(*session, 0), nullptr);
    EXPECT_FALSE(has("compare.view.split"));
    click("compare.start");
    EXPECT_TRUE(frames_until([&] { return !comparison().running() && !comparison().stale(*session); }));
    EXPECT_NE(comparison().picture(*session, 0), nullptr);
}

TEST_F(ComparePanel, KeepsPointsBesideTheLiveOne) {
    compare();
    session->render();
    session->graph().finish_timings();
    click("compare.keep");
    ASSERT_EQ(comparison().points.size(), 1u);
    EXPECT_NEAR(comparison().points[0].figures["relative_rmse"], comparison().figures()["relative_rmse"], 1e-12);
    EXPECT_GT(comparison().points[0].ms, 0);
    EXPECT_EQ(comparison().points[0].transport, "0 bounces: direct + emission");
    // A time of other settings makes no point.
    session->graph().forget_timings();
    click("compare.keep");
    EXPECT_EQ(comparison().points.size(), 1u);
}

TEST_F(ComparePanel, Stops) {
    start(0.001f);
    ASSERT_TRUE(frames_until([&] { return has("compare.stop"); }));
    click("compare.stop");
    EXPECT_FALSE(comparison().running());
    frame();
    EXPECT_TRUE(has("compare.start"));
}

} // namespace
} // namespace bounce
