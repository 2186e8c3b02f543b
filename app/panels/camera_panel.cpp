// The camera in numbers, its bookmarks, the size of the picture, and time.
#include "app/panels/panel.h"
#include "app/ui/camera_control.h"
#include "app/ui/camera_path.h"
#include "app/ui/marks.h"
#include "app/ui/shot_writer.h"
#include "app/ui/style.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui_stdlib.h>

namespace bounce {

namespace {

/// A loaded place as numbers of the file's coordinates.
bool drag_place(const char* label, glm::vec3& place, const LoadedSpace& space, float speed) {
    glm::dvec3 file = space.to_file(place);
    bool changed = edit_number(label, file, [&](glm::dvec3& value) {
        return ImGui::DragScalarN(label, ImGuiDataType_Double, &value.x, 3, speed, nullptr, nullptr, "%.3f");
    });
    if (!changed) return false;
    place = space.to_loaded(file);
    return true;
}

void draw_numbers(PanelContext& context) {
    Session& session = context.session;
    Camera camera = session.camera();
    const LoadedSpace& space = session.shot().scene.space;
    float speed = 0.001f * float(space.unit) * std::max(session.facts().bounds_over_animation.diagonal(), 1e-3f);
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 4.5f);
    bool changed = drag_place("position", camera.position, space, speed);
    note_widget("camera.position");
    changed = drag_place("target", camera.target, space, speed) || changed;
    changed = edit_number("up", camera.up,
                          [](glm::vec3& up) { return ImGui::DragFloat3("up", &up.x, 0.005f, -1, 1, "%.3f"); }) ||
              changed;
    float degrees = glm::degrees(camera.vfov);
    if (edit_number("field", degrees, [](float& value) {
            return ImGui::SliderFloat("field", &value, 5, 120, "%.1f°", ImGuiSliderFlags_AlwaysClamp);
        })) {
        camera.vfov = glm::radians(degrees);
        changed = true;
    }
    note_widget("camera.field");
    help("Vertical field of view.");
    ImGui::PopItemWidth();
    bool looks = glm::distance(camera.position, camera.target) > 1e-6f && glm::length(camera.up) > 1e-6f;
    if (changed && looks) {
        session.set_camera(camera);
        context.ui.redraw();
    }
    ImGui::BeginDisabled(!session.camera_is_set() && !camera_path_edited(session.shot(), context.ui.window.opened));
    if (ImGui::Button("shot's camera")) go_to_shot_camera(context);
    ImGui::EndDisabled();
    help("Home does the same.");
    ImGui::SameLine();
    if (ImGui::Button("whole scene")) {
        session.set_camera(camera_of_whole_scene(session), true);
        context.ui.redraw();
    }
    help("F does the same.");
    ImGui::SameLine();
    if (ImGui::Button("copy")) {
        ImGui::SetClipboardText(camera_json(session.camera(), session.shot().scene.space).c_str());
        context.ui.say("the camera is on the clipboard, as a shot file holds it");
    }
    help("As JSON, for a shot file.");
}

/// Between two bookmarks or more.
void draw_path(PanelContext& context) {
    WindowState& window = context.ui.window;
    Session& session = context.session;
    if (bookmarks_of(window, session).size() < 2) return;
    if (ImGui::Button("path through them")) make_camera_path(context);
    note_widget("camera.path");
    help("The camera goes from bookmark to bookmark, from the first frame on. Home drops the path.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 4);
    edit_number("s each", window.path_seconds, [](float& value) {
        return ImGui::DragFloat("s each", &value, 0.05f, 0.1f, 600, "%.3g", ImGuiSliderFlags_AlwaysClamp);
    });
    note_widget("camera.path_seconds");
    help("Seconds from one bookmark to the next, for the next path that is made.");
    if (!session.camera_is_set() || !camera_path_edited(session.shot(), window.opened)) return;
    if (ImGui::Button("follow the path")) {
        session.follow_shot_camera();
        context.ui.redraw();
    }
    note_widget("camera.follow_path");
    help("The camera was moved by hand since.");
}

void draw_bookmarks(PanelContext& context) {
    WindowState& state = context.ui.window;
    const std::string& shot = context.session.options().shot;
    static std::string name;
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 3.2f);
    bool enter =
        ImGui::InputTextWithHint("##name", "name of a new bookmark", &name, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    int number = 0;
    bool add = ImGui::Button("add", {-1, 0});
    note_widget("camera.add_bookmark");
    int remove = -1;
    for (int i = 0; i < int(state.bookmarks.size()); ++i) {
        const Bookmark& mark = state.bookmarks[size_t(i)];
        if (mark.shot != shot) continue;
        ++number;
        ImGui::PushID(i);
        ImGui::TextColored(k_dim_colour, "%s", number <= 9 ? std::to_string(number).c_str() : " ");
        ImGui::SameLine(ImGui::GetFontSize() * 1.6f);
        if (ImGui::Selectable(mark.name.c_str(), false, 0,
                              {ImGui::GetContentRegionAvail().x - ImGui::GetFontSize() * 2, 0})) {
            context.session.set_camera(mark.camera, true);
            context.ui.redraw();
        }
        ImGui::SameLine();
        if (ImGui::SmallButton("×")) remove = i;
        help("Forget this bookmark.");
        ImGui::PopID();
    }
    if (remove >= 0) state.bookmarks.erase(state.bookmarks.begin() + remove);
    if (number == 0) ImGui::TextColored(k_dim_colour, "none for this shot (B adds one)");
    if (add || enter) {
        state.bookmarks.push_back(
            {shot, name.empty() ? fmt::format("view {}", number + 1) : name, context.session.camera()});
        name.clear();
    }
    draw_path(context);
}

void draw_size(PanelContext& context) {
    PictureSizing& sizing = context.ui.window.sizing;
    const Shot& shot = context.session.shot();
    int choice = sizing.fit ? 0 : sizing.fixed.x > 0 ? 2 : 1;
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 3);
    if (ImGui::Combo("size", &choice, "of the window\0of the shot\0fixed\0")) {
        sizing.fit = choice == 0;
        sizing.fixed = choice == 2 ? context.session.size() : glm::ivec2(0);
    }
    if (choice == 1) help(fmt::format("{}×{}", shot.width, shot.height).c_str());
    if (choice == 2) {
        glm::ivec2 size = sizing.fixed;
        ImGui::InputInt2("pixels", &size.x);
        // Only when typing is done: half a number would allocate half a picture.
        if (ImGui::IsItemDeactivatedAfterEdit()) sizing.fixed = glm::clamp(size, glm::ivec2(16), glm::ivec2(8192));
    }
    static const float scales[] = {0.25f, 0.5f, 0.75f, 1.0f, 2.0f};
    std::string shown = fmt::format("×{:g}", sizing.scale);
    if (ImGui::BeginCombo("scale", shown.c_str())) {
        for (float scale : scales) {
            if (ImGui::Selectable(fmt::format("×{:g}", scale).c_str(), scale == sizing.scale)) sizing.scale = scale;
        }
        ImGui::EndCombo();
    }
    help("Fewer pixels are rendered on a slow machine.");
    ImGui::PopItemWidth();
    ImGui::Checkbox("coarse while moving", &context.ui.window.coarse_while_moving);
    note_widget("camera.coarse_while_moving");
    help(
        "Where a frame takes more than 100 ms, fewer pixels are rendered while the camera or a value moves, and all of "
        "them when it rests. Only for a picture of the window's size.");
    ImGui::TextColored(k_dim_colour, "%d × %d pixels", context.session.size().x, context.session.size().y);
}

void draw_time(PanelContext& context) {
    Session& session = context.session;
    UiState& ui = context.ui;
    if (ImGui::Button(ui.paused ? "play" : "pause", {ImGui::GetFontSize() * 4, 0})) ui.paused = !ui.paused;
    note_widget("camera.play");
    ImGui::SameLine();
    if (ImGui::Button("step")) ui.single_step = true;
    note_widget("camera.step");
    ImGui::SameLine();
    if (ImGui::Button("start")) {
        session.set_frame(0);
        ui.redraw();
    }
    ImGui::SameLine();
    if (ImGui::Checkbox("always", &ui.render_always)) ui.redraw();
    help("Render continuously, also when nothing changes: to measure, or to let a method converge.");
    int frame = session.frame();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
    if (ImGui::InputInt("frame", &frame, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue)) {
        session.set_frame(std::clamp(frame, 0, 10000000));
        ui.redraw();
    }
    ImGui::SameLine();
    ImGui::TextColored(k_dim_colour, "%.3f s", double(session.time()));
}

/// Newest at the right; those of earlier settings are dim. Lines at 16.7 and 33.3 ms.
void draw_bars(const std::vector<FrameTime>& frames, float top) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 1.0f), ImGui::GetFontSize() * 4.5f);
    ImGui::InvisibleButton("history", size);
    note_widget("camera.frame_times");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float bottom = from.y + size.y, right = from.x + size.x;
    list.AddRectFilled(from, {right, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    const float width = std::max(size.x / 120, 2.0f);
    float x = right;
    for (auto frame = frames.rbegin(); frame != frames.rend() && x > from.x; ++frame, x -= width) {
        const float height = std::max(size.y * std::min(frame->ms / top, 1.0f), 1.0f);
        const ImU32 colour = ImGui::GetColorU32(ImGuiCol_PlotHistogram, frame->current ? 1.0f : 0.35f);
        list.AddRectFilled({std::max(x - width + 1, from.x), bottom - height}, {x, bottom}, colour);
    }
    for (float budget : {16.7f, 33.3f}) {
        const float y = bottom - budget / top * size.y;
        if (budget <= top) list.AddLine({from.x, y}, {right, y}, IM_COL32(255, 255, 255, 60));
    }
}

void draw_history(const UiState& ui) {
    if (ui.frame_times.empty()) return;
    std::vector<float> all, current;
    for (const FrameTime& frame : ui.frame_times) {
        all.push_back(frame.ms);
        if (frame.current) current.push_back(frame.ms);
    }
    std::sort(all.begin(), all.end());
    std::sort(current.begin(), current.end());
    // The scale ignores a lone outlier, such as a shader that was compiled.
    draw_bars(ui.frame_times, std::max(1.3f * all[all.size() * 95 / 100], 1.0f));
    help("The last frames, panels and display included; dim: of earlier settings. Lines: 16.7 and 33.3 ms.");
    if (current.empty()) return ImGui::TextColored(k_dim_colour, "no frame of these settings yet");
    const float median = current[current.size() / 2], high = current[current.size() * 95 / 100];
    show_wrapped(fmt::format("{} frame{}: median {:.1f} ms, 95 % {:.1f}, worst {:.1f}", current.size(),
                             current.size() == 1 ? "" : "s", median, high, current.back()),
                 k_dim_colour);
}

} // namespace

void draw_camera_panel(PanelContext& context) {
    ImGui::PushID("camera");
    if (ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) draw_numbers(context);
    if (ImGui::CollapsingHeader("Bookmarks", ImGuiTreeNodeFlags_DefaultOpen)) draw_bookmarks(context);
    if (ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) draw_size(context);
    if (ImGui::CollapsingHeader("Time", ImGuiTreeNodeFlags_DefaultOpen)) {
        draw_time(context);
        draw_history(context.ui);
    }
    ImGui::PopID();
}

} // namespace bounce
