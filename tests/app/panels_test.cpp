// The graph, shaders, resources and inspector panels: what is pressed changes what it should, and undo takes it back.
#include "app/panel_fixture.h"
#include "app/panels/shader_errors.h"
#include "app/panels/viewer_settings.h"
#include "app/pass_rows.h"
#include "app/ui/texel.h"
#include "app/ui/texture_view.h"
#include "gpu/barrier.h"

namespace bounce {
namespace {

// --- graph -----------------------------------------------------------------------------------------------------------

TEST_F(PanelsTest, GraphSwitchesPassesAndTakesItBack) {
    show(draw_graph_panel);
    ASSERT_TRUE(has("graph.pass.direct"));
    click("graph.enabled.direct");
    EXPECT_FALSE(session->graph().model().find_node("direct")->enabled);
    std::vector<PassRow> rows = pass_rows(session->graph().model(), session->graph().plan());
    auto row = std::find_if(rows.begin(), rows.end(), [](auto& r) { return r.id == "direct"; });
    ASSERT_NE(row, rows.end());
    EXPECT_EQ(row->plan, -1);
    EXPECT_EQ(row->skipped, "switched off");
    EXPECT_TRUE(has("graph.enabled.direct"));
    EXPECT_EQ(undo.next_undo(), "switch off direct");
    undo.undo();
    frame();
    EXPECT_TRUE(session->graph().model().find_node("direct")->enabled);
    undo.redo();
    frame();
    EXPECT_FALSE(session->graph().model().find_node("direct")->enabled);
    click("graph.enabled.direct");
    EXPECT_TRUE(session->graph().model().find_node("direct")->enabled);
    EXPECT_FALSE(ui.notice_is_error) << ui.notice;
}

TEST_F(PanelsTest, GraphRowsHoverAndPin) {
    show(draw_graph_panel);
    point_at("graph.pass.direct");
    frame();
    frame();
    EXPECT_EQ(ui.hovered, "out.direct");
    EXPECT_EQ(ui.pinned, "");
    click("graph.pass.direct");
    EXPECT_EQ(ui.pinned, "out.direct");
    click("graph.pass.gbuffer");
    EXPECT_EQ(ui.pinned, "gbuffer.albedo");
    EXPECT_EQ(ui.hovered, "gbuffer.albedo");
    click("graph.pass.gbuffer");
    EXPECT_EQ(ui.pinned, "");
    ImGui::GetIO().MousePos = ImVec2(-100, -100);
    frame();
    EXPECT_EQ(ui.hovered, "");
}

TEST_F(PanelsTest, GraphRowsKeepTheirPlaces) {
    auto ids = [&] {
        std::vector<std::string> names;
        for (const PassRow& row : pass_rows(session->graph().model(), session->graph().plan()))
            names.push_back(row.id);
        return names;
    };
    std::vector<std::string> all = ids();
    EXPECT_EQ(all.size(), session->graph().model().nodes().size());
    session->graph().model().find_node("direct")->enabled = false;
    session->graph().touch();
    session->render();
    EXPECT_EQ(ids(), all);
}

TEST_F(PanelsTest, GraphDetailsNameEverything) {
    const Plan& plan = session->graph().plan();
    for (const PlanPass& pass : plan.passes) {
        std::string details = pass_details(session->graph().model(), plan, pass);
        for (const PlanSlot& slot : pass.slots)
            EXPECT_THAT(details, testing::HasSubstr(slot.bind.resource)) << pass.id;
        EXPECT_THAT(details, testing::HasSubstr(barrier_text(pass.barriers))); // "" when there are none
    }
    EXPECT_EQ(resource_text(*plan.find_resource("out.direct")), "rgba16f 64×36, 18.0 KiB");
}

TEST_F(PanelsTest, GraphFileProblemsShow) {
    fs::path file = folder / "changing.json";
    fs::copy_file(session->graph().model().file().path, file, fs::copy_options::overwrite_existing);
    open(file.string());
    show(draw_graph_panel);
    EXPECT_FALSE(has("graph.problem"));
    std::ofstream(file) << "{ \"version\": 1, \"passes\": [";
    ASSERT_TRUE(session->poll_files());
    frame();
    EXPECT_TRUE(has("graph.problem"));
    EXPECT_TRUE(has("graph.pass.direct")); // the last good plan goes on
}

// --- shaders ---------------------------------------------------------------------------------------------------------

TEST_F(PanelsOnOwnShader, ShaderErrorsAreRows) {
    open_own();
    show(draw_shaders_panel);
    const Program& program = *session->graph().model().nodes()[0]->programs[0];
    EXPECT_EQ(shader_error_count(session->graph()), 0);
    EXPECT_EQ(program_state(program), ProgramState::good);
    EXPECT_FALSE(has("shaders.error.0"));
    write("colour += nonsense;");
    ASSERT_TRUE(session->poll_files());
    session->render();
    frame();
    EXPECT_GE(shader_error_count(session->graph()), 1);
    EXPECT_EQ(program_state(*session->graph().model().nodes()[0]->programs[0]), ProgramState::old_text);
    ASSERT_TRUE(has("shaders.error.0"));
    click("shaders.copy.0");
    EXPECT_THAT(clipboard(), testing::HasSubstr("paint.comp:13"));
    EXPECT_THAT(clipboard(), testing::HasSubstr("colour += nonsense;"));
    panel = draw_graph_panel; // the row of the pass says so too
    frame();
    EXPECT_TRUE(session->graph().pass_is_stale("paint"));
    panel = draw_shaders_panel;
    write("");
    ASSERT_TRUE(session->poll_files());
    session->render();
    frame();
    EXPECT_EQ(shader_error_count(session->graph()), 0);
    EXPECT_FALSE(has("shaders.error.0"));
    click("shaders.program.paint"); // unfolds its files
    EXPECT_FALSE(ui.notice_is_error) << ui.notice;
}

// --- resources -------------------------------------------------------------------------------------------------------

TEST_F(PanelsTest, ResourcesChooseWhatIsShown) {
    show(draw_resources_panel);
    for (const PlanResource& resource : session->graph().plan().resources)
        EXPECT_TRUE(has("resources.row." + resource.name())) << resource.name();
    click("resources.row.gbuffer.depth");
    EXPECT_EQ(ui.viewer.resource, "gbuffer.depth");
    EXPECT_EQ(ui.pinned, "gbuffer.depth");
    EXPECT_TRUE(ui.viewer.automatic_range);
    EXPECT_EQ(shown_view(session->graph(), ui).resource, "gbuffer.depth");
    click("resources.row.out.direct");
    EXPECT_EQ(ui.pinned, "out.direct");
    EXPECT_TRUE(ui.viewer.encode_srgb);
    frame();
    click("viewer.channel.2");
    EXPECT_EQ(ui.viewer.channel, 2);
    click("viewer.automatic_range");
    EXPECT_TRUE(ui.viewer.automatic_range);
    ui.hovered = "gbuffer.normal"; // wins, with settings of its own
    EXPECT_EQ(shown_view(session->graph(), ui).resource, "gbuffer.normal");
    EXPECT_EQ(shown_view(session->graph(), ui).channel, 0);
    ui.hovered.clear();
    EXPECT_EQ(shown_view(session->graph(), ui).channel, 2);
    click("resources.row.out.direct");
    EXPECT_EQ(ui.pinned, "");
    EXPECT_EQ(shown_view(session->graph(), ui).resource, "out.display");
}

TEST_F(PanelsOnOwnShader, BufferWordsAreRead) {
    open_own();
    show(draw_resources_panel);
    click("resources.row.paint.numbers");
    EXPECT_EQ(ui.buffer.resource, "paint.numbers");
    frame();
    click("buffer.words.3");
    EXPECT_EQ(ui.buffer.words, 3);
    ui.buffer.page = 99; // of two
    frame();
    EXPECT_EQ(ui.buffer.page, 1);
    click("resources.row.paint.numbers");
    EXPECT_EQ(ui.buffer.resource, "");
    EXPECT_EQ(word_text(0x3f800000u, 0), "1");
    EXPECT_EQ(word_text(0xffffffffu, 1), "4294967295");
    EXPECT_EQ(word_text(0xffffffffu, 2), "-1");
    EXPECT_EQ(word_text(0xabcu, 3), "00000abc");
}

// --- inspector -------------------------------------------------------------------------------------------------------

TEST_F(PanelsTest, InspectorShowsExactValues) {
    show(draw_inspector_panel);
    EXPECT_FALSE(has("inspector.gbuffer.depth")); // nothing is pointed at
    ui.cursor_pixel = {20, 30};
    ui.cursor_uv = (glm::vec2(ui.cursor_pixel) + 0.5f) / glm::vec2(64, 36);
    frame();
    frame();
    click("inspector.gbuffer.albedo");
    EXPECT_EQ(clipboard(), to_text(read_texel(*session->graph().texture("gbuffer.albedo"), 0, {20, 30, 0})));
    std::vector<float> depths = session->graph().texture("gbuffer.depth")->read();
    auto position = world_position(session->constants(), {20, 30}, depths[30 * 64 + 20]);
    ASSERT_TRUE(position);
    click("inspector.position (m)");
    glm::vec3 told(0);
    ASSERT_EQ(std::sscanf(clipboard().c_str(), "%f, %f, %f", &told.x, &told.y, &told.z), 3);
    EXPECT_LT(glm::distance(told, *position), 1e-3f);
    EXPECT_GE(told.y, session->facts().bounds_over_animation.min.y - 0.01f);
    // What is shown instead of the picture, at its own size.
    ui.pinned = "shadow.depth";
    frame();
    EXPECT_TRUE(has("inspector.R"));
    EXPECT_FALSE(has("inspector.G"));
    click("inspector.lock");
    EXPECT_TRUE(ui.cursor_locked);
}

TEST_F(PanelsTest, EveryPanelDrawsOnEveryStep) {
    ui.cursor_pixel = {5, 5};
    ui.cursor_uv = {0.1f, 0.1f};
    for (auto draw :
         {draw_graph_panel, draw_parameters_panel, draw_shaders_panel, draw_resources_panel, draw_inspector_panel}) {
        show(draw);
        // Over every row: tooltips are drawn too.
        nlohmann::json all = widgets; // each frame replaces them
        for (const auto& [name, rectangle] : all.items()) {
            ImGui::GetIO().MousePos = ImVec2(rectangle[0].get<float>() + 4, rectangle[1].get<float>() + 4);
            frame();
        }
        ImGui::GetIO().MousePos = ImVec2(-100, -100);
    }
    EXPECT_FALSE(ui.notice_is_error) << ui.notice;
}

} // namespace
} // namespace bounce
