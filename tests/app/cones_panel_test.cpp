// The cones panel: what it switches on, the pixel that it sends, the table that comes back.
#include "app/panel_fixture.h"
#include "app/panels/cones_panel.h"

namespace bounce {
namespace {

TEST_F(PanelsTest, ConesFollowThePointer) {
    show(draw_cones_panel); // the direct graph gathers no cones
    EXPECT_FALSE(has("cones.on"));
    open("lrsm");
    show(draw_cones_panel);
    click("cones.on");
    EXPECT_TRUE(session->graph().model().find_node("inspect")->enabled);
    EXPECT_TRUE(session->graph().model().find_node("view_cones")->enabled);
    frame();
    ui.cursor_pixel = {40, 30};
    for (int i = 0; i < 4; ++i)
        frame(); // the pixel goes out, a frame is rendered, its records come back
    ASSERT_TRUE(ui.cones);
    EXPECT_EQ(ui.cones->records.inspected.pixel, glm::ivec2(40, 30));
    EXPECT_EQ(ui.cones->records.inspected.cones, 6);
    ASSERT_TRUE(has("cones.cone.5"));
    EXPECT_TRUE(has("cones.sphere.0"));
    click("cones.cone.3");
    EXPECT_EQ(ui.cones->chosen, 3);
    EXPECT_NE(session->command_line("x.png").find("--enable inspect"), std::string::npos);
    EXPECT_NE(session->command_line("x.png").find("--set inspect.pixel="), std::string::npos);

    ui.cursor_pixel = {-1, -1}; // outside: the last pixel stays
    frame();
    EXPECT_EQ(ui.cones->records.inspected.cones, 6);
    click("cones.draw");
    EXPECT_EQ(ui.pinned, "debug.cones_view");
    click("cones.on");
    EXPECT_FALSE(session->graph().model().find_node("inspect")->enabled);
    EXPECT_FALSE(has("cones.cone.0"));
    ui.cones.reset();
}

} // namespace
} // namespace bounce
