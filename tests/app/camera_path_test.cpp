// A path of the camera through bookmarks.
#include "app/tiny_session.h"
#include "app/ui/camera_path.h"
#include "app/ui/open.h"
#include "app/ui/shot_writer.h"
#include "app/ui/work.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace bounce;
using testing::HasSubstr;

static Camera camera_at(glm::vec3 position, glm::vec3 target = glm::vec3(0)) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    return camera;
}

TEST(CameraPath, GoesThroughAllCamerasInTime) {
    const std::vector<Camera> cameras = {camera_at({0, 0, 5}), camera_at({3, 1, 5}, {1, 0, 0}),
                                         camera_at({4, 2, 0}, {0, 1, 0}), camera_at({0, 2, -5})};
    const Path path = path_through(cameras, {}, 1, 2, 60);
    for (size_t i = 0; i < cameras.size(); ++i) {
        const PathKey key = path.at(1 + 2 * float(i));
        EXPECT_EQ(glm::vec3(key.position), cameras[i].position);
        EXPECT_EQ(glm::vec3(key.target), cameras[i].target);
    }
    for (size_t i = 1; i < path.keys.size(); ++i)
        EXPECT_GT(path.keys[i].t, path.keys[i - 1].t);
    // It has no corner: from key to key its direction turns little, at the bookmarks too.
    for (size_t i = 2; i < path.keys.size(); ++i) {
        const glm::dvec3 a = glm::normalize(path.keys[i - 1].position - path.keys[i - 2].position);
        const glm::dvec3 b = glm::normalize(path.keys[i].position - path.keys[i - 1].position);
        EXPECT_GT(glm::dot(a, b), std::cos(glm::radians(8.0))) << i;
    }
}

TEST(CameraPath, TwoCamerasAreAStraightLineAndKeysAreNoDenserThanFrames) {
    const Path path = path_through({camera_at({0, 0, 5}), camera_at({4, 0, 5})}, {}, 0, 0.1f, 30);
    EXPECT_EQ(path.keys.size(), 4u);
    for (const PathKey& key : path.keys)
        EXPECT_NEAR(key.position.x, 40 * double(key.t), 1e-5);
    // Far from zero floats do not tell close times apart: no key is at the time of another.
    const Path late = path_through({camera_at({0, 0, 5}), camera_at({4, 0, 5})}, {}, 1e6f, 0.2f, 60);
    for (size_t i = 1; i < late.keys.size(); ++i)
        EXPECT_GT(late.keys[i].t, late.keys[i - 1].t);
}

TEST(CameraPath, LooksSomewhereWherePositionAndTargetMeet) {
    const Path path = path_through({camera_at({-1, 0, 0}, {1, 0, 0}), camera_at({1, 0, 0}, {-1, 0, 0})}, {}, 0, 1, 24);
    for (const PathKey& key : path.keys)
        EXPECT_GT(glm::distance(key.position, key.target), 1e-3) << key.t;
}

class CameraPathTest : public GpuTest {
  protected:
    void open(const std::string& graph) {
        SessionOptions options = tiny_session(root.path());
        options.graph = graph;
        options.rebuild = Rebuild::on_change;
        session = std::make_unique<Session>(options);
        ui.window.opened = baseline_of(*session);
        own = session->camera();
        for (glm::vec3 to : {glm::vec3(0.4f, 1, 2), glm::vec3(-0.6f, 0.7f, 1.8f), glm::vec3(-1.2f, 1.1f, 0.9f)}) {
            Camera camera = own;
            camera.position = to;
            ui.window.bookmarks.push_back({options.shot, "view", camera});
        }
        ui.window.bookmarks.push_back({"another shot", "view", camera_at({9, 9, 9})});
        ui.window.path_seconds = 0.2f;
    }
    static std::vector<float> picture(Session& session) {
        session.render(true);
        return session.graph().texture("out.radiance")->read();
    }
    PanelContext context() { return {*session, ui, undo}; }

    TempRoot root;
    std::unique_ptr<Session> session;
    UiState ui;
    UndoStack undo;
    Camera own;
};

class CameraPathInGraph : public CameraPathTest, public testing::WithParamInterface<const char*> {};

TEST_P(CameraPathInGraph, TheSavedShotHasTheSameFrames) {
    open(GetParam());
    picture(*session);
    session->advance();
    picture(*session);
    PanelContext panels = context();
    make_camera_path(panels);
    session->measure_moved_needs();
    EXPECT_EQ(session->frame(), 0);
    EXPECT_EQ(ui.window.capture.frames, 25) << "0.4 s at 60 frames a second, both ends included";
    EXPECT_TRUE(differs_from_shot(*session, ui.window.opened));
    root.write("saved.json", shot_text(*session, ui.window.opened, root.path()));
    SessionOptions again = session->options();
    again.shot = (root.path() / "saved.json").string();
    again.rebuild = Rebuild::every_frame;
    Session fresh(again);
    const std::vector<float> first = picture(fresh);
    EXPECT_EQ(picture(*session), first);
    for (int frame = 1; frame < 4; ++frame) {
        session->advance();
        fresh.advance();
        const std::vector<float> now = picture(fresh);
        EXPECT_NE(now, first) << "the camera moves";
        EXPECT_EQ(picture(*session), now) << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Graphs, CameraPathInGraph, testing::Values("direct", "dvs_tuned"),
                         [](const auto& graph) { return std::string(graph.param); });

TEST_F(CameraPathTest, HomeDropsItAndUndoBringsItBack) {
    open("direct");
    const std::vector<float> before = picture(*session);
    PanelContext panels = context();
    make_camera_path(panels);
    EXPECT_EQ(undo.next_undo(), "camera path");
    session->set_frame(24);
    EXPECT_EQ(session->camera().position, ui.window.bookmarks[2].camera.position);
    go_to_shot_camera(panels);
    EXPECT_FALSE(differs_from_shot(*session, ui.window.opened));
    session->set_frame(0);
    EXPECT_EQ(picture(*session), before);
    undo.undo();
    EXPECT_EQ(session->shot().camera_path.keys.size(), 25u);
    undo.undo();
    EXPECT_TRUE(session->shot().camera_path.empty());
    EXPECT_EQ(picture(*session), before);
    undo.redo();
    EXPECT_EQ(session->shot().camera_path.keys.size(), 25u);
}

TEST_F(CameraPathTest, ItIsWorkThatIsKept) {
    open("direct");
    ui.window.bookmarks[0].camera.vfov = 0.5f;
    PanelContext panels = context();
    make_camera_path(panels);
    session->set_frame(7);
    const std::vector<float> seventh = picture(*session);
    keep_work(panels);
    session->open_shot(session->options().shot);
    EXPECT_EQ(restore_shot_work(panels), "the camera's path");
    session->set_frame(7);
    EXPECT_EQ(picture(*session), seventh);
}

TEST_F(CameraPathTest, OneBookmarkIsNoPath) {
    open("direct");
    ui.window.bookmarks.erase(ui.window.bookmarks.begin(), ui.window.bookmarks.begin() + 2);
    PanelContext panels = context();
    make_camera_path(panels);
    EXPECT_TRUE(ui.notice_is_error);
    EXPECT_THAT(ui.notice, HasSubstr("two bookmarks"));
    EXPECT_FALSE(differs_from_shot(*session, ui.window.opened));
}
