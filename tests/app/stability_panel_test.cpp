// The Stability panel: a case on the shown graph with what is edited of it, step by step.

#include "app/panel_fixture.h"
#include "app/ui/stability_run.h"

namespace bounce {

using StabilityPanel = PanelsTest;

TEST_F(StabilityPanel, MeasuresTheGraphAsItIsSetNow) {
    open("traced");
    show(draw_stability_panel);
    ASSERT_TRUE(ui.stability);
    ui.stability->chosen = "two_runs";
    const std::vector<float> before = session->graph().texture("out.radiance")->read();
    click("stability.run");
    for (int i = 0; i < 8 && ui.stability->running(); ++i)
        frame();
    ASSERT_FALSE(ui.stability->running());
    EXPECT_EQ(ui.stability->problem(), "");
    ASSERT_TRUE(ui.stability->measurement());
    EXPECT_TRUE(ui.stability->measurement()->done());
    EXPECT_EQ(ui.stability->measurement()->curve(), (std::vector<double>{0}));
    // What the window shows is not touched.
    session->render();
    EXPECT_EQ(session->graph().texture("out.radiance")->read(), before);

    // Without what is measured there is a reason, and the panel lives on.
    session->graph().model().switch_pass("gather", false);
    session->graph().touch();
    click("stability.run");
    for (int i = 0; i < 8 && ui.stability->running(); ++i)
        frame();
    EXPECT_NE(ui.stability->problem(), "");
    frame();
    EXPECT_TRUE(has("stability.curve"));
}

TEST_F(StabilityPanel, ACaseThatIsNoneIsTold) {
    show(draw_stability_panel);
    ui.stability->chosen = "no_such_case";
    frame();
    point_at("stability.run");
    frame();
    press(true);
    EXPECT_THROW(press(false), Error);
    EXPECT_FALSE(ui.stability->running());
}

} // namespace bounce
