// Placed objects that are moved: the picture is that of the saved shot, whatever the graph had kept of the old place.
#include "app/tiny_session.h"
#include "app/ui/object_place.h"
#include "app/ui/open.h"
#include "app/ui/shot_writer.h"
#include "app/ui/work.h"
#include "scene/turn.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace bounce;
using testing::HasSubstr;

class ObjectPlaceTest : public GpuTest {
  protected:
    SessionOptions options(const std::string& graph) {
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1})
            .quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, {0.8f, 0.2f, 0.2f})
            .write(root.path(), "room");
        TinyScene().box({-0.2f, 0, -0.2f}, {0.2f, 0.5f, 0.2f}, {0.2f, 0.7f, 0.3f}).write(root.path(), "block");
        SessionOptions out;
        out.shot = write_shot(root.path(), "placed", "room.gltf", {0.4f, 1, 2.4f}, {0, 0.3f, 0},
                              R"({"type":"point","position":[-0.7,1.4,0.6],"intensity":3})",
                              R"(,"objects":[{"scene":"block.gltf","name":"block","position":[-0.3,0,0],"scale":0.9},
                                 {"scene":"block.gltf","rotation":[0,30,0],"path":[{"t":0,"position":[0.5,0,0.2]},
                                 {"t":1,"position":[0.5,0,-0.4]}]}])");
        out.graph = graph;
        out.size = {48, 32};
        out.rebuild = Rebuild::on_change; // as the window: what stands is kept
        return out;
    }
    void open(const std::string& graph) {
        session = std::make_unique<Session>(options(graph));
        ui.window.opened = baseline_of(*session);
    }
    static std::vector<float> picture(Session& session) {
        session.render(true);
        return session.graph().texture("out.radiance")->read();
    }
    std::vector<float> picture_of_saved_shot() {
        root.write("saved.json", shot_text(*session, ui.window.opened, root.path()));
        SessionOptions again = session->options();
        again.shot = (root.path() / "saved.json").string();
        Session fresh(again);
        return picture(fresh);
    }
    PanelContext context() { return {*session, ui, undo}; }
    void move(size_t object, const ObjectPlace& place) {
        PanelContext panels = context();
        move_object(panels, object, place);
    }

    TempRoot root;
    std::unique_ptr<Session> session;
    UiState ui;
    UndoStack undo;
};

class ObjectInGraph : public ObjectPlaceTest, public testing::WithParamInterface<const char*> {};

TEST_P(ObjectInGraph, ThePictureIsThatOfTheSavedShot) {
    open(GetParam());
    const std::vector<float> before = picture(*session);
    EXPECT_FALSE(differs_from_shot(*session, ui.window.opened));
    ObjectPlace place = place_of_object(*session, 0);
    place.position = {0.1, 0.25, -0.3};
    place.rotation = rotation_of({10, 33.3, 5}) * turn_between({0, 0, 1}, {0.6, 0, 0.8});
    place.scale = {1.2, 0.7, 1};
    move(0, place);
    session->measure_moved_needs();
    const std::vector<float> moved = picture(*session);
    EXPECT_NE(moved, before);
    EXPECT_TRUE(session->graph().problems().empty());
    EXPECT_EQ(moved, picture_of_saved_shot());
    undo.undo();
    session->measure_moved_needs();
    EXPECT_EQ(picture(*session), before);
    EXPECT_FALSE(differs_from_shot(*session, ui.window.opened));
}

INSTANTIATE_TEST_SUITE_P(Graphs, ObjectInGraph,
                         testing::Values("direct", "dvs_tuned", "traced", "vf_tuned", "lrsm_tuned"),
                         [](const auto& graph) { return std::string(graph.param); });

TEST_F(ObjectPlaceTest, WhatWasEditedIsWrittenInTheKeysOfShots) {
    open("direct");
    ObjectPlace place = place_of_object(*session, 0);
    EXPECT_EQ(name_of_object(session->shot(), 0), "block 1");
    EXPECT_EQ(name_of_object(session->shot(), 1), "block 2");
    place.rotation = rotation_of({0, 90, 0});
    place.scale = glm::dvec3(0.5);
    move(0, place);
    auto saved = nlohmann::json::parse(shot_text(*session, ui.window.opened, root.path()));
    EXPECT_EQ(saved["objects"][0],
              nlohmann::json::parse(
                  R"({"scene":"block.gltf","name":"block","position":[-0.3,0,0],"rotation":[0,90,0],"scale":0.5})"));
    place.rotation = turn_between({0, 0, 1}, {0.6, 0, 0.8});
    move(0, place);
    saved = nlohmann::json::parse(shot_text(*session, ui.window.opened, root.path()));
    EXPECT_EQ(saved["objects"][0]["rotation"].size(), 4u) << "no round angles say it: a quaternion does";
    EXPECT_EQ(edited_objects(session->shot(), ui.window.opened), 1u);
    EXPECT_EQ(unsaved_edits(*session, ui.window.opened), "") << "a shot file holds it";
}

TEST_F(ObjectPlaceTest, APathKeepsWhatItHas) {
    open("direct");
    EXPECT_FALSE(freedom_of_object(session->shot(), 1).move);
    EXPECT_TRUE(freedom_of_object(session->shot(), 1).turn) << "it has no targets";
    const ObjectPlace was = place_of_object(*session, 1);
    EXPECT_EQ(was.position, glm::dvec3(0.5, 0, 0.2));
    ObjectPlace place = was;
    place.position = {9, 9, 9};
    place.scale = glm::dvec3(2);
    move(1, place);
    EXPECT_EQ(place_of_object(*session, 1).position, was.position);
    EXPECT_EQ(place_of_object(*session, 1).scale, glm::dvec3(2));
    EXPECT_EQ(picture(*session), picture_of_saved_shot());
}

TEST_F(ObjectPlaceTest, WhatCannotBeLoadedIsRefused) {
    open("direct");
    const ObjectPlace was = place_of_object(*session, 0);
    ObjectPlace place = was;
    place.scale.y = 0;
    move(0, place);
    EXPECT_TRUE(ui.notice_is_error);
    EXPECT_THAT(ui.notice, HasSubstr("scale"));
    place = was;
    place.position.x = 1e25;
    move(0, place);
    EXPECT_TRUE(ui.notice_is_error);
    EXPECT_EQ(place_of_object(*session, 0).position, was.position);
    EXPECT_EQ(place_of_object(*session, 0).scale, was.scale);
    EXPECT_EQ(undo.next_undo(), "");
    EXPECT_EQ(picture(*session), picture_of_saved_shot());
}

TEST_F(ObjectPlaceTest, ItIsWorkThatIsKept) {
    open("direct");
    ObjectPlace place = place_of_object(*session, 0);
    place.position.z = 0.25;
    place.rotation = rotation_of({1, 2, 3});
    move(0, place);
    const std::vector<float> moved = picture(*session);
    PanelContext panels = context();
    keep_work(panels);
    session->open_shot(session->options().shot);
    undo.clear();
    EXPECT_NE(picture(*session), moved);
    EXPECT_EQ(restore_shot_work(panels), "1 object");
    EXPECT_EQ(picture(*session), moved);
    // Of a shot that has other objects now, nothing is taken.
    root.edit("placed.json", R"("name":"block")", R"("name":"brick")");
    session->open_shot(session->options().shot);
    const std::vector<float> other = picture(*session);
    EXPECT_EQ(restore_shot_work(panels), "");
    EXPECT_TRUE(ui.notice_is_error);
    EXPECT_EQ(picture(*session), other);
}
