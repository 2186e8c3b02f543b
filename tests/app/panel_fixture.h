#pragma once
// A panel on a real session without a window: frames of Dear ImGui that nobody sees, and a pointer that presses widgets
// by their names.

#include "app/hosts/headless.h"
#include "app/panels/panel.h"
#include "app/ui/widget_rects.h"
#include "support/temp_folder.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <imgui.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <unistd.h>
#include <utility>

namespace bounce {

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
        for (auto& action : std::exchange(ui.window.later, {}))
            action();
        if (ui.redraw_frames > 0) session->render(), --ui.redraw_frames;
        std::ifstream file(folder / "widgets.json");
        widgets = nlohmann::json::parse(file)["widgets"];
    }
    void show(void (*draw)(PanelContext&)) {
        panel = draw;
        for (int i = 0; i < 3; ++i)
            frame(); // sizes of tables and windows settle
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

/// A graph of one shader that tests can write to.
class PanelsOnOwnShader : public PanelsTest {
  protected:
    /// Shaders are read from below a root's glsl alone.
    fs::path shaders() {
        fs::create_directories(root.path() / "glsl/user");
        return root.path() / "glsl/user";
    }
    void write(const std::string& line) {
        static int count = 0; // a text of another length each time, so that any watcher sees it
        fs::path aside = shaders() / "paint.tmp";
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
} // )" << std::string(size_t(++count), 'x')
                             << "\n";
        fs::rename(aside, shaders() / "paint.comp");
    }
    void open_own() {
        write("");
        nlohmann::json graph = {
            {"version", 1},
            {"resources",
             {{"out.display", {{"format", "rgba8"}}},
              {"paint.numbers", {{"kind", "buffer"}, {"count", "64"}, {"stride", 16}}}}},
            {"passes",
             {{{"id", "paint"}, {"type", "compute"}, {"shader", "user/paint.comp"}, {"params", {{"scale", 2.5}}}}}}};
        std::ofstream(folder / "paint.json") << graph.dump(2);
        open((folder / "paint.json").string());
    }

    TempRoot root;
};

} // namespace bounce
