// The panels, drawn without a window on a real session: what is pressed changes what it should, and undo takes it back.
#include "app/hosts/headless.h"
#include "app/panels/panel.h"
#include "app/panels/parameter_edit.h"
#include "app/panels/parameter_widget.h"
#include "app/panels/pass_rows.h"
#include "app/panels/shader_errors.h"
#include "app/panels/viewer_settings.h"
#include "app/ui/texel.h"
#include "app/ui/texture_view.h"
#include "app/ui/widget_rects.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <imgui.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace bounce {
namespace {

namespace fs = std::filesystem;

class PanelsTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        context = std::make_unique<HeadlessContext>();
        folder = fs::temp_directory_path() / ("bounce_panels_test_" + std::to_string(getpid()));
        fs::create_directories(folder);
        start_widget_dump(folder / "widgets.json");
    }
    static void TearDownTestSuite() {
        start_widget_dump({});
        fs::remove_all(folder);
        context.reset();
    }

    void SetUp() override {
        errors_before = high_severity_messages();
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = ImVec2(420, 1600);
        io.DeltaTime = 1.0f / 60;
        io.MousePos = ImVec2(-100, -100);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        open("direct");
    }
    void TearDown() override {
        ImGui::DestroyContext();
        session.reset();
        EXPECT_EQ(high_severity_messages(), errors_before);
    }

    void open(const std::string& graph) {
        session.reset();
        SessionOptions options;
        options.shot = "cornell";
        options.graph = graph;
        options.size = glm::ivec2(64, 36);
        session = std::make_unique<Session>(options);
        panel_context.emplace(PanelContext{*session, ui, undo});
        session->render();
    }

    /// One frame of the window with this panel alone in it.
    void frame() {
        begin_widget_frame();
        ui.hovered.clear();
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
        panel(*panel_context);
        ImGui::End();
        ImGui::Render();
        end_widget_frame(*panel_context);
        for (auto& action : std::exchange(ui.window.later, {})) action();
        if (ui.redraw_frames > 0) session->render(), --ui.redraw_frames;
        std::ifstream file(folder / "widgets.json");
        widgets = nlohmann::json::parse(file)["widgets"];
    }
    void show(void (*draw)(PanelContext&)) {
        panel = draw;
        for (int i = 0; i < 3; ++i) frame(); // sizes of tables and windows settle
    }
    bool has(const std::string& name) const { return widgets.contains(name); }
    void point_at(const std::string& name, float across = 0.5f) {
        ASSERT_TRUE(has(name)) << name << " is not among " << widgets.dump(1);
        auto r = widgets[name].get<std::vector<float>>();
        ImGui::GetIO().MousePos = ImVec2(r[0] + across * (r[2] - r[0]), 0.5f * (r[1] + r[3]));
    }
    void press(bool down, int button = 0) {
        ImGui::GetIO().MouseDown[button] = down;
        frame();
    }
    void click(const std::string& name, int button = 0) {
        frame(); // what was just changed is drawn
        point_at(name);
        frame();
        press(true, button);
        press(false, button);
        frame();
    }
    void drag(const std::string& name, float from, float to) {
        point_at(name, from);
        frame();
        press(true);
        for (int step = 1; step <= 5; ++step) {
            point_at(name, from + (to - from) * float(step) / 5);
            frame();
        }
        press(false);
        frame();
    }
    const Parameter& parameter(const std::string& name) { return session->graph().model().parameter(name); }
    std::string text(const std::string& name) { return to_text(parameter(name).info, parameter(name).value); }
    static std::string clipboard() {
        const char* text = ImGui::GetClipboardText();
        return text ? text : "";
    }

    static inline std::unique_ptr<HeadlessContext> context;
    static inline fs::path folder;
    uint64_t errors_before = 0;
    std::unique_ptr<Session> session;
    UiState ui;
    UndoStack undo;
    std::optional<PanelContext> panel_context;
    void (*panel)(PanelContext&) = nullptr;
    nlohmann::json widgets;
};

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
    EXPECT_EQ(row->declined, "switched off");
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
        for (const PassRow& row : pass_rows(session->graph().model(), session->graph().plan())) names.push_back(row.id);
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
        for (const PlanSlot& slot : pass.slots) EXPECT_THAT(details, testing::HasSubstr(slot.bind.resource)) << pass.id;
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

// --- parameters ------------------------------------------------------------------------------------------------------

TEST_F(PanelsTest, SliderDragIsOneStepOfUndo) {
    show(draw_parameters_panel);
    ASSERT_EQ(text("direct.depth_bias"), "0.1");
    uint64_t frames = session->graph().frames();
    drag("direct.depth_bias", 0.25f, 0.75f);
    float value = std::get<float>(parameter("direct.depth_bias").value);
    EXPECT_NEAR(value, 12, 1);
    EXPECT_EQ(parameter("direct.depth_bias").origin, ParameterOrigin::panel);
    EXPECT_GT(session->graph().frames(), frames); // and it was rendered again
    EXPECT_EQ(undo.next_undo(), "direct.depth_bias");
    undo.undo();
    EXPECT_EQ(text("direct.depth_bias"), "0.1");
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

/// A graph of one shader that tests can write to.
class PanelsOnOwnShader : public PanelsTest {
  protected:
    void write(const std::string& line) {
        static int count = 0; // a text of another length each time, so that any watcher sees it
        fs::path aside = folder / "paint.tmp";
        std::ofstream(aside) << R"(layout(local_size_x = 8, local_size_y = 8) in;
uniform int steps = 4;  //! static [1, 64] unrolled steps
uniform float scale = 1.0;  //! [0.0001, 100] (metres) a length
uniform vec2 offset = vec2(1.0, 2.0);  //! a shift
uniform vec4 weights = vec4(0.25);  //! [0, 1] shares
uniform vec3 tint = vec3(1.0, 0.5, 0.0);  //! a colour
uniform int seed = 7;  //! any whole number
layout(FORMAT_out_display) writeonly uniform image2D out_display;
layout(std430) buffer paint_numbers { uvec4 numbers[]; };
void main() {
    vec3 colour = tint * scale * weights.xyz + vec3(offset, float(seed + steps));
    if (gl_GlobalInvocationID.x < 64u) numbers[gl_GlobalInvocationID.x] = uvec4(gl_GlobalInvocationID.x);
    )" << line << R"(
    imageStore(out_display, ivec2(gl_GlobalInvocationID.xy), vec4(colour, 1.0));
} // )" << std::string(size_t(++count), 'x') << "\n";
        fs::rename(aside, folder / "paint.comp");
    }
    void open_own() {
        write("");
        nlohmann::json graph = {
            {"version", 1},
            {"resources", {{"out.display", {{"format", "rgba8"}}}, {"paint.numbers", {{"kind", "buffer"}, {"count", "64"}, {"stride", 16}}}}},
            {"passes", {{{"id", "paint"}, {"type", "compute"}, {"shader", (folder / "paint.comp").string()}, {"params", {{"scale", 2.5}}}}}}};
        std::ofstream(folder / "paint.json") << graph.dump(2);
        open((folder / "paint.json").string());
    }
};

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
    for (const char* name : {"paint.steps", "paint.scale", "paint.offset", "paint.weights", "paint.tint", "paint.seed"}) EXPECT_TRUE(has(name)) << name;
    drag("paint.offset", 0.25f, 0.45f);
    EXPECT_NE(text("paint.offset"), "1,2");
    drag("paint.weights", 0.05f, 0.2f);
    EXPECT_NE(text("paint.weights"), "0.25,0.25,0.25,0.25");
    drag("paint.seed", 0.3f, 0.9f);
    EXPECT_NE(text("paint.seed"), "7");
    drag("paint.tint", 0.1f, 0.3f);
    EXPECT_EQ(text("paint.tint").substr(text("paint.tint").find(',')), ",0.5,0");
    for (int i = 0; i < 4; ++i) undo.undo();
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
    for (const PlanResource& resource : session->graph().plan().resources) EXPECT_TRUE(has("resources.row." + resource.name())) << resource.name();
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
    for (auto draw : {draw_graph_panel, draw_parameters_panel, draw_shaders_panel, draw_resources_panel, draw_inspector_panel}) {
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
