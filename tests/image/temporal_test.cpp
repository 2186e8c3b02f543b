// Accumulation over frames: what stands converges to what ever more rays would give; what moves is followed or dropped.
#include "app/experiments/sweep.h"
#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace bounce;

namespace {

using Picture = std::vector<float>;

class Temporal : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.7f, 0.6f, 0.5f})
            .quad({-1, 0, -1}, {1, 0, -1}, {1, 1.5f, -1}, {-1, 1.5f, -1}, {0.6f, 0.6f, 0.7f})
            .quad({-1, 0, 1}, {-1, 0, -1}, {-1, 1.5f, -1}, {-1, 1.5f, 1}, {0.7f, 0.2f, 0.2f})
            .write(folder.path(), "room");
        TinyScene().box({-0.2f, 0, -0.2f}, {0.2f, 0.4f, 0.2f}, {0.8f, 0.8f, 0.8f}).write(folder.path(), "mover");
    }

    std::string shot(const std::string& more = "") {
        return write_shot(folder.path(), "room", "room.gltf", {0.4f, 0.9f, 2.6f}, {0, 0.4f, 0},
                          R"({"type":"spot","position":[0.3,1.4,0.7],"direction":[-0.2,-1,-0.3],)"
                          R"("intensity":6,"outer_cone_deg":60})",
                          more);
    }

    static SessionOptions options(const std::string& shot, const std::string& graph, ParameterValues sets) {
        SessionOptions out;
        out.shot = shot;
        out.graph = graph;
        out.size = {48, 48};
        out.sets = std::move(sets);
        out.sets.emplace_back("graph.accumulate", "true");
        return out;
    }

    static void frames(Session& session, int count) {
        for (int i = 0; i < count; ++i) {
            session.render(true);
            session.advance(); // for the next one
        }
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
    }

    static int64_t counter(Session& session, const std::string& label) {
        for (const CounterValue& value : session.graph().counters())
            if (value.label == label) return value.value;
        ADD_FAILURE() << "no counter '" << label << "'";
        return -1;
    }

    static Picture part(const Session& session) { return session.graph().texture("out.indirect_diffuse")->read(); }

    TempFolder folder;
};

double error_of(const Picture& a, const Picture& truth) {
    double sum = 0, mean = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
        if (i % 4 == 3) continue;
        sum += std::pow(double(a.at(i)) - double(truth[i]), 2);
        mean += truth[i];
    }
    const double count = double(truth.size()) * 0.75;
    return std::sqrt(sum / count) / (mean / count);
}

double mean_of(const Picture& a) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        if (i % 4 < 3) sum += a[i];
    return sum;
}

class TemporalOf : public Temporal, public testing::WithParamInterface<const char*> {};

} // namespace

/// Few rays in each of many frames come to what the graph gives with many rays, without any filter.
TEST_P(TemporalOf, AStillPictureConvergesToManyRays) {
    const std::string name = GetParam(), room = shot();
    const bool traced = name == "traced";
    const std::string rays = traced ? "gather.rays" : "gather.spiral_cones";
    Session many(options(room, name, {{rays, "64"}, {"filter_1.radius", "0"}, {"filter_2.radius", "0"}}));
    frames(many, 24);
    const Picture truth = part(many);
    Session few(options(room, name, {{rays, "8"}}));
    frames(few, 1);
    const double first = error_of(part(few), truth);
    frames(few, 63);
    const Picture last = part(few);
    EXPECT_EQ(counter(few, "frames held, at most"), 64);
    EXPECT_LT(error_of(last, truth), 0.3 * first);
    EXPECT_LT(error_of(last, truth), 0.04);
    EXPECT_NEAR(mean_of(last) / mean_of(truth), 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Graphs, TemporalOf,
                         testing::Values("traced", "dvs_traced", "lrsm_traced", "dvs_tuned", "lrsm_tuned"),
                         [](auto& of) { return std::string(of.param); });

TEST_F(Temporal, AnEditDropsWhatWasHeld) {
    Session session(options(shot(), "traced", {}));
    frames(session, 4);
    EXPECT_EQ(counter(session, "frames held, at most"), 4);
    session.shot().scene.lights[0].intensity *= 0.5f;
    session.scene_edited();
    frames(session, 1);
    EXPECT_EQ(counter(session, "frames held, at most"), 1);
}

/// What comes into view holds one frame; all else keeps its history, and so less noise than one frame has.
TEST_F(Temporal, TheCamerasMotionIsFollowed) {
    Session session(
        options(shot(), "traced", {{"gather.rays", "4"}, {"filter_1.radius", "0"}, {"filter_2.radius", "0"}}));
    Camera camera = session.camera();
    camera.position.z = 1; // the back wall fills the view
    for (int i = 0; i < 12; ++i) {
        const float step = i < 11 ? -0.02f : -0.2f; // by some texels in the end
        camera.position.x += step;
        camera.target.x += step;
        session.set_camera(camera);
        frames(session, 1);
    }
    const double held = double(counter(session, "texels with history")),
                 seen = double(counter(session, "texels with a surface"));
    EXPECT_GT(held, 0.8 * seen);
    EXPECT_LT(held, seen); // at the border something came in
    EXPECT_GT(counter(session, "frames held, at most"), 8);

    Session many(
        options(shot(), "traced", {{"gather.rays", "64"}, {"filter_1.radius", "0"}, {"filter_2.radius", "0"}}));
    many.set_camera(camera);
    frames(many, 16);
    Session single(
        options(shot(), "traced", {{"gather.rays", "4"}, {"filter_1.radius", "0"}, {"filter_2.radius", "0"}}));
    single.set_camera(camera);
    frames(single, 1);
    EXPECT_LT(error_of(part(session), part(many)), 0.7 * error_of(part(single), part(many)));
}

/// The G-buffer tells where an object's surfaces were a frame ago.
TEST_F(Temporal, MotionIsThatOfTheObject) {
    const std::string moving = shot(R"(,"fps":10,"objects":[{"scene":"mover.gltf","path":[)"
                                    R"({"t":0,"position":[0,0,0]},{"t":1,"position":[0.5,0.2,-0.3]}]}])");
    Session session(options(moving, "traced", {}));
    frames(session, 3);
    const Picture motion = session.graph().texture("gbuffer.motion")->read();
    int moved = 0, stood = 0;
    for (size_t i = 0; i + 3 < motion.size(); i += 4) {
        const glm::vec3 m(motion[i], motion[i + 1], motion[i + 2]);
        if (glm::length(m) < 1e-5f) {
            ++stood;
            continue;
        }
        ++moved;
        EXPECT_LT(glm::length(m - glm::vec3(-0.05f, -0.02f, 0.03f)), 1e-3f);
    }
    EXPECT_GT(moved, 50);
    EXPECT_GT(stood, 500);
}

/// Behind an object that moves on there is no ghost: where it was, the light is soon that of a fresh start.
TEST_F(Temporal, NoGhostStaysBehindAMovingObject) {
    const std::string moving =
        shot(R"(,"fps":10,"objects":[{"scene":"mover.gltf","path":[)"
             R"({"t":0,"position":[-0.5,0,0.2]},{"t":0.5,"position":[0.5,0,0.2]},{"t":9,"position":[0.5,0,0.2]}]}])");
    Session session(options(moving, "traced", {}));
    frames(session, 7); // at .6 s it has stood for a frame
    Session many(options(moving, "traced", {{"gather.rays", "64"}}));
    many.set_frame(6);
    frames(many, 1);
    Session single(options(moving, "traced", {}));
    single.set_frame(6);
    frames(single, 1);
    EXPECT_LT(error_of(part(session), part(many)), 1.25 * error_of(part(single), part(many)));
    EXPECT_NEAR(mean_of(part(session)) / mean_of(part(many)), 1, 0.04);
}
