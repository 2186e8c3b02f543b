// The session: what both hosts drive.
#include "app/capture.h"
#include "app/timings.h"
#include "app/tiny_session.h"
#include "support/errors.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;

class SessionTest : public GpuTest {
  protected:
    SessionOptions options() { return tiny_session(root.path()); }
    std::vector<float> picture(Session& session) { return session.graph().texture("out.radiance")->read(); }
    TempRoot root;
};

TEST_F(SessionTest, BadOptionsAreToldTogetherWithTheNearest) {
    SessionOptions bad = options();
    bad.sets = {{"tonemap.exposre", "1"}, {"tonemap.exposure", "100"}, {"exposure", "1"}, {"tonemap.curve", "aces"}};
    std::string text = error_of([&] { Session session(bad); });
    EXPECT_THAT(text,
                AllOf(HasSubstr("4 errors"), HasSubstr("did you mean 'tonemap.exposure'?"), HasSubstr("[-16, 16]"),
                      HasSubstr("pass.parameter"), HasSubstr("did you mean 'aces_like'?")));
    bad = options();
    bad.graph = "driect";
    EXPECT_THAT(error_of([&] { Session session(bad); }), HasSubstr("did you mean 'direct'?"));
}

TEST_F(SessionTest, TheSameFramesGiveTheSameBits) {
    Session one(options()), two(options());
    for (int frame = 0; frame < 3; ++frame) {
        if (frame) one.advance();
        one.render();
    }
    two.set_frame(2);
    two.render();
    two.render();
    EXPECT_EQ(picture(one), picture(two));
}

/// A frame that had no room for all is rendered again: what it left behind may not count in means over frames.
TEST_F(SessionTest, AFrameThatIsRenderedAgainCountsOnceInAMean) {
    SessionOptions small = options();
    small.graph = "ldm_indirect_tuned";
    small.sets = {{"ldm.maps", "16"}, {"ldm.resolution", "32"}, {"rsm.resolution", "32"}};
    SessionOptions tight = small;
    tight.sets.emplace_back("ldm.fragments", "0.1");
    tight.switches = {{"accumulate", true}};
    Session one(small), two(tight);
    one.render(true);
    two.render(true);
    std::vector<float> mean = two.graph().texture("accumulate.mean")->read();
    EXPECT_EQ(mean[3], 1);
    EXPECT_EQ(picture(one), picture(two));
    two.advance();
    two.render(true);
    EXPECT_EQ(two.graph().texture("accumulate.mean")->read()[3], 2);
    EXPECT_EQ(picture(one), picture(two)) << "the mean of two frames that are the same";
}

TEST_F(SessionTest, AGraphThatCannotBeOpenedLeavesTheOldOneRunning) {
    Session session(options());
    session.render();
    std::vector<float> before = picture(session);
    root.write("assets/graphs/bad.json",
               R"({"version":1,"resources":{"out.radiance":{"size":[100000,100000]}},"passes":[{"type":"gbuffer"},
        {"id":"compose","type":"compute","shader":"surface/compose.comp"}]})");
    EXPECT_THAT(error_of([&] { session.open_graph("bad"); }), HasSubstr("out.radiance"));
    EXPECT_THAT(error_of([&] { session.open_shot("no_such_shot"); }), HasSubstr("no_such_shot"));
    session.graph().touch();
    session.render();
    EXPECT_TRUE(session.graph().problems().empty());
    EXPECT_EQ(picture(session), before);
}

TEST_F(SessionTest, ResizingAndLightsThatComeAndGo) {
    Session session(options());
    session.render();
    session.resize({20, 10});
    session.render();
    EXPECT_EQ(picture(session).size(), 800u);
    session.shot().scene.lights[0].enabled = false;
    session.scene_edited();
    session.render();
    EXPECT_THAT(picture(session), testing::Each(testing::AnyOf(0, 1))) << "black, with an alpha of 1";
    EXPECT_EQ(session.graph().texture("shadow.depth"), nullptr) << "nothing is modelled that the scene does not need";
    session.shot().scene.lights[0].enabled = true;
    session.scene_edited();
    session.render();
    std::vector<float> lit = picture(session);
    EXPECT_THAT(lit, testing::Contains(testing::Not(testing::AnyOf(0, 1))));
    EXPECT_TRUE(session.graph().problems().empty());
}

TEST_F(SessionTest, TheCommandLineMakesThePictureAgain) {
    Session session(options());
    session.set_frame(2);
    session.set_parameter("tonemap.curve", "aces_like", ParameterOrigin::panel);
    EXPECT_THAT(session.command_line("x.png"),
                AllOf(HasSubstr("--graph direct"), HasSubstr("--size 32x18"), HasSubstr("--frames 3"),
                      HasSubstr("--set shadow_maps.resolution=64"), HasSubstr("--set tonemap.curve=aces_like"),
                      HasSubstr("-o x.png")));
}

TEST_F(SessionTest, MetadataAndTimings) {
    Session session(options());
    session.render();
    auto metadata = nlohmann::json::parse(picture_metadata(session, "gbuffer.normal"));
    EXPECT_EQ(metadata["graph"], "direct");
    EXPECT_EQ(metadata["resource"], "gbuffer.normal");
    EXPECT_EQ(metadata["parameters"]["shadow_maps.resolution"], "64");
    EXPECT_EQ(metadata["size"], nlohmann::json::array({32, 18}));
    EXPECT_FALSE(metadata["commit"].get<std::string>().empty());
    EXPECT_FALSE(metadata["renderer"].get<std::string>().empty());
    session.graph().finish_timings();
    write_timings(session, root / "t.json");
    auto timings = nlohmann::json::parse(root.read("t.json"));
    uint64_t bytes = 0;
    for (const auto& [name, value] : timings["resources"].items())
        bytes += value.get<uint64_t>();
    EXPECT_EQ(bytes, timings["total_bytes"].get<uint64_t>());
    EXPECT_EQ(timings["resources"]["shadow.depth"], 64 * 64 * 4 * 6);
    for (const auto& pass : timings["passes"])
        EXPECT_GT(pass["median_ms"].get<double>(), 0) << pass;
    EXPECT_THAT(timing_table(session), AllOf(HasSubstr("gbuffer"), HasSubstr("emission: skipped")));
}
