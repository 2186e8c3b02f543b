// The parameters panel: every kind of widget, one step of undo a drag, resetting and copying.
#include "app/panel_fixture.h"
#include "app/panels/parameter_edit.h"
#include "app/panels/parameter_widget.h"
#include "app/panels/shader_errors.h"

namespace bounce {
namespace {

TEST_F(PanelsTest, SliderDragIsOneStepOfUndo) {
    show(draw_parameters_panel);
    const std::string before = text("direct.depth_bias");
    uint64_t frames = session->graph().frames();
    drag("direct.depth_bias", 0.25f, 0.75f);
    float value = std::get<float>(parameter("direct.depth_bias").value);
    EXPECT_NEAR(value, 12, 1);
    EXPECT_EQ(parameter("direct.depth_bias").origin, ParameterOrigin::panel);
    EXPECT_GT(session->graph().frames(), frames); // and it was rendered again
    EXPECT_EQ(undo.next_undo(), "direct.depth_bias");
    undo.undo();
    EXPECT_EQ(text("direct.depth_bias"), before);
    EXPECT_EQ(parameter("direct.depth_bias").origin, ParameterOrigin::default_value);
    EXPECT_EQ(undo.next_undo(), "");
    undo.redo();
    EXPECT_EQ(std::get<float>(parameter("direct.depth_bias").value), value);
    EXPECT_FALSE(ui.notice_is_error) << ui.notice;
}

TEST_F(PanelsTest, SwitchesAndChoices) {
    show(draw_parameters_panel);
    ASSERT_EQ(text("direct.shadows"), "true");
    point_at("direct.shadows", 0.05f); // a checkbox is at the left of its cell
    click("direct.shadows");
    EXPECT_EQ(text("direct.shadows"), "false");
    ASSERT_EQ(text("tonemap.curve"), "none");
    click("tonemap.curve");
    frame();
    click("tonemap.curve.aces_like");
    EXPECT_EQ(text("tonemap.curve"), "aces_like");
    EXPECT_EQ(undo.next_undo(), "tonemap.curve");
    undo.undo();
    EXPECT_EQ(text("tonemap.curve"), "none");
    undo.undo();
    EXPECT_EQ(text("direct.shadows"), "true");
    EXPECT_EQ(undo.next_undo(), "");
}

TEST_F(PanelsTest, ResetAndCopy) {
    session->set_parameter("direct.filter_radius", "2", ParameterOrigin::command_line);
    session->set_parameter("tonemap.exposure", "-1.5", ParameterOrigin::panel);
    show(draw_parameters_panel);
    click("direct.filter_radius.mark");
    frame();
    click("direct.filter_radius.copy");
    EXPECT_EQ(clipboard(), "--set direct.filter_radius=2");
    click("direct.filter_radius", 1); // the right button opens the same menu
    frame();
    click("direct.filter_radius.reset");
    EXPECT_EQ(text("direct.filter_radius"), "0");
    EXPECT_EQ(parameter("direct.filter_radius").origin, ParameterOrigin::default_value);
    undo.undo();
    EXPECT_EQ(text("direct.filter_radius"), "2");
    EXPECT_EQ(parameter("direct.filter_radius").origin, ParameterOrigin::command_line);
    frame();
    click("parameters.copy_all");
    EXPECT_EQ(clipboard(), "--set direct.filter_radius=2 --set tonemap.exposure=-1.5");
    click("parameters.reset_all");
    EXPECT_TRUE(session->changed_parameters(ParameterOrigin::command_line).empty());
    undo.undo();
    EXPECT_EQ(text("tonemap.exposure"), "-1.5");
    EXPECT_EQ(text("direct.filter_radius"), "2");
}

TEST_F(PanelsTest, FilterNarrowsTheList) {
    ui.parameter_filter = "BIAS";
    show(draw_parameters_panel);
    EXPECT_TRUE(has("direct.depth_bias"));
    EXPECT_FALSE(has("direct.shadows"));
    ui.parameter_filter = "percentage-closer"; // in the help
    frame();
    EXPECT_TRUE(has("direct.filter_radius"));
    EXPECT_FALSE(has("direct.depth_bias"));
    ui.parameter_filter.clear();
    ui.only_changed_parameters = true;
    session->set_parameter("tonemap.exposure", "1", ParameterOrigin::panel);
    frame();
    EXPECT_TRUE(has("tonemap.exposure"));
    EXPECT_FALSE(has("direct.filter_radius"));
}

TEST_F(PanelsTest, LogarithmicSliders) {
    ParameterInfo info;
    info.min = 0.001, info.max = 10;
    EXPECT_TRUE(has_logarithmic_slider(info));
    info.min = 0;
    EXPECT_FALSE(has_logarithmic_slider(info));
    info.min = 0.1;
    EXPECT_FALSE(has_logarithmic_slider(info));
}

TEST_F(PanelsOnOwnShader, CompiledInParametersWaitForTheEndOfTheDrag) {
    open_own();
    show(draw_parameters_panel);
    point_at("paint.steps", 0.2f);
    frame();
    press(true);
    for (float at : {0.4f, 0.6f, 0.8f}) {
        point_at("paint.steps", at);
        frame();
        EXPECT_EQ(text("paint.steps"), "4");
    }
    EXPECT_GT(std::get<int>(ui.edit.value), 40);
    press(false);
    EXPECT_GT(std::get<int>(parameter("paint.steps").value), 40);
    frame();
    EXPECT_TRUE(shader_problems(session->graph()).empty());
    undo.undo();
    EXPECT_EQ(text("paint.steps"), "4");
}

TEST_F(PanelsOnOwnShader, EveryKindHasAWidget) {
    open_own();
    show(draw_parameters_panel);
    for (const char* name : {"paint.steps", "paint.scale", "paint.offset", "paint.weights", "paint.tint", "paint.seed"})
        EXPECT_TRUE(has(name)) << name;
    drag("paint.offset", 0.25f, 0.45f);
    EXPECT_NE(text("paint.offset"), "1,2");
    drag("paint.weights", 0.05f, 0.2f);
    EXPECT_NE(text("paint.weights"), "0.25,0.25,0.25,0.25");
    drag("paint.seed", 0.3f, 0.9f);
    EXPECT_NE(text("paint.seed"), "7");
    drag("paint.tint", 0.1f, 0.3f);
    EXPECT_EQ(text("paint.tint").substr(text("paint.tint").find(',')), ",0.5,0");
    for (int i = 0; i < 4; ++i)
        undo.undo();
    EXPECT_EQ(undo.next_undo(), "");
    EXPECT_EQ(text("paint.offset"), "1,2");
    EXPECT_EQ(text("paint.tint"), "1,0.5,0");
    // The middle of a logarithmic slider is the geometric mean.
    drag("paint.scale", 0.4f, 0.5f);
    EXPECT_NEAR(std::log10(std::get<float>(parameter("paint.scale").value)), -1, 0.15);
    // Reset goes to what the graph file says.
    click("parameters.reset_all");
    EXPECT_EQ(text("paint.scale"), "2.5");
    EXPECT_EQ(parameter("paint.scale").origin, ParameterOrigin::graph);
    EXPECT_FALSE(ui.notice_is_error) << ui.notice;
}

TEST_F(PanelsTest, AGridTakesPowersOfTwoAlone) {
    open("voxel_ao");
    ui.parameter_filter = "occlusion_voxels.";
    show(draw_parameters_panel);
    click("occlusion_voxels.resolution");
    frame();
    EXPECT_TRUE(has("occlusion_voxels.resolution.8"));
    EXPECT_TRUE(has("occlusion_voxels.resolution.512"));
    EXPECT_FALSE(has("occlusion_voxels.resolution.100"));
    click("occlusion_voxels.resolution.32");
    EXPECT_EQ(text("occlusion_voxels.resolution"), "32");
    EXPECT_EQ(undo.next_undo(), "occlusion_voxels.resolution");
    EXPECT_FALSE(ui.notice_is_error) << ui.notice;
}

TEST_F(PanelsTest, WhatTheGraphCannotRunWithIsRefused) {
    open("voxel_ao");
    session->set_parameter("occlusion_voxels.route", "raster", ParameterOrigin::panel);
    session->set_parameter("occlusion_voxels.storage", "bytes", ParameterOrigin::command_line);
    session->render();
    ui.parameter_filter = "occlusion_voxels.";
    show(draw_parameters_panel);
    click("occlusion_voxels.storage");
    frame();
    click("occlusion_voxels.storage.bits");
    EXPECT_EQ(text("occlusion_voxels.storage"), "bytes");
    EXPECT_EQ(parameter("occlusion_voxels.storage").origin, ParameterOrigin::command_line);
    EXPECT_TRUE(ui.notice_is_error);
    EXPECT_THAT(ui.notice, testing::HasSubstr("storage = bits needs route = compute"));
    EXPECT_THAT(ui.notice, testing::HasSubstr("occlusion_voxels.storage stays bytes"));
    EXPECT_EQ(undo.next_undo(), "");
    session->render();
    EXPECT_TRUE(session->graph().problems().empty());
    // Out of a state that cannot run, steps are allowed.
    session->set_parameter("occlusion_voxels.storage", "bits", ParameterOrigin::panel);
    EXPECT_TRUE(apply(*session, ui, {{"occlusion_voxels.resolution", "16", ParameterOrigin::panel}}));
    EXPECT_TRUE(apply(*session, ui, {{"occlusion_voxels.route", "compute", ParameterOrigin::panel}}));
    session->render();
    EXPECT_TRUE(session->graph().problems().empty());
}

TEST_F(PanelsTest, ADoubleClickOnTheNameResets) {
    session->set_parameter("tonemap.exposure", "2", ParameterOrigin::panel);
    show(draw_parameters_panel);
    click("tonemap.exposure.name");
    EXPECT_EQ(text("tonemap.exposure"), "2");
    press(true);
    press(false);
    EXPECT_EQ(text("tonemap.exposure"), "0");
    undo.undo();
    EXPECT_EQ(text("tonemap.exposure"), "2");
}

TEST_F(PanelsTest, AnEditThatIsLeftByAnotherCounts) {
    show(draw_parameters_panel);
    ui.edit = {"shadow_maps.resolution", text("shadow_maps.resolution"), ParameterOrigin::default_value, 128, true};
    drag("tonemap.exposure", 0.5f, 0.7f);
    EXPECT_EQ(text("shadow_maps.resolution"), "128");
    EXPECT_NE(text("tonemap.exposure"), "0");
    undo.undo();
    undo.undo();
    EXPECT_NE(text("shadow_maps.resolution"), "128");
}

} // namespace
} // namespace bounce
