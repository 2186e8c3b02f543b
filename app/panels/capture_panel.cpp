// Pictures, sequences, films, shots and presets as files, and the command that makes the picture again.
#include "app/graph_preset.h"
#include "app/panels/panel.h"
#include "app/ui/captures.h"
#include "app/ui/keys.h"
#include "app/ui/marks.h"
#include "app/ui/shot_writer.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <imgui_stdlib.h>

namespace bounce {

namespace {

/// Between frames, so that an Error shows in the status bar and the log.
void later(PanelContext& context, void (*action)(PanelContext&)) {
    context.ui.window.ask([&session = context.session, &ui = context.ui, &undo = context.undo, action] {
        PanelContext again{session, ui, undo};
        action(again);
    });
}

void draw_pictures(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 3.5f);
    ImGui::InputText("folder", &capture.folder);
    help("Where files go; made when it is not there. Relative to where the program was started.");
    if (ImGui::Button("PNG")) later(context, [](PanelContext& c) { capture_picture(c, ".png"); });
    note_widget("capture.png");
    help(("What the window shows as the final picture (" + chord_of(KeyCommand::capture_png) + ").").c_str());
    ImGui::SameLine();
    if (ImGui::Button("EXR")) later(context, [](PanelContext& c) { capture_picture(c, ".exr"); });
    help(("Every linear part as a named layer (" + chord_of(KeyCommand::capture_exr) + ").").c_str());
    if (capture.last.empty()) return;
    show_wrapped(capture.last, k_dim_colour);
    if (ImGui::IsItemClicked()) ImGui::SetClipboardText(capture.last.c_str());
    help("The last file; a click copies its path.");
}

void draw_sequence(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    if (capture.recording) {
        if (ImGui::Button("stop")) later(context, stop_recording);
        ImGui::SameLine();
        if (capture.frames > 0) {
            char text[48];
            std::snprintf(text, sizeof(text), "%d of %d", capture.written, capture.frames);
            ImGui::ProgressBar(float(capture.written) / float(capture.frames), {-1, 0}, text);
        } else {
            ImGui::Text("%d frames", capture.written);
        }
        show_wrapped(capture.pattern, k_dim_colour);
        return;
    }
    if (ImGui::Button("record")) later(context, start_recording);
    note_widget("capture.record");
    help(("Each frame, from the present one on (" + chord_of(KeyCommand::record) + ").").c_str());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    static const char* const kinds[] = {"numbered PNG", "MP4", "WebM"};
    const bool open = ImGui::BeginCombo("##kind", kinds[size_t(capture.kind)]);
    note_widget("capture.kind");
    for (int kind = 0; open && kind < 3; ++kind) {
        if (ImGui::Selectable(kinds[kind], kind == int(capture.kind))) capture.kind = RecordingKind(kind);
        note_widget(std::string("capture.kind.") + kinds[kind]);
    }
    if (open) ImGui::EndCombo();
    help("Films are written by ffmpeg, where that is installed, at the shot's frames per second.");
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
    ImGui::InputInt("frames", &capture.frames, 1, 30);
    note_widget("capture.frames");
    capture.frames = std::clamp(capture.frames, 0, 1000000);
    help("0: until stopped.");
}

void draw_reproduction(PanelContext& context) {
    if (ImGui::Button("save shot")) later(context, [](PanelContext& c) { save_shot(c); });
    note_widget("capture.save_shot");
    help(("Camera, lights, environment, size and time as a shot file (" + chord_of(KeyCommand::save_shot) + ").")
             .c_str());
    std::string command = reproducing_command(context);
    static std::string name;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6);
    ImGui::InputTextWithHint("##shot_name", "name of a new shot", &name);
    note_widget("capture.shot_name");
    ImGui::SameLine();
    ImGui::BeginDisabled(name.empty());
    if (ImGui::Button("into the list")) later(context, [](PanelContext& c) { save_shot_in_list(c, name); });
    ImGui::EndDisabled();
    note_widget("capture.shot_in_list");
    help("As a file of the assets' shots, so that the list of shots has it.");
    ImGui::BeginDisabled(command.empty());
    if (ImGui::Button("copy command")) {
        ImGui::SetClipboardText(command.c_str());
        context.ui.say("the command line is on the clipboard");
    }
    ImGui::EndDisabled();
    if (command.empty()) {
        show_wrapped("The camera or the scene is not the shot's any more: save the shot, and the command that makes "
                     "this picture stands here.",
                     k_warning_colour);
    } else {
        ImGui::PushFont(fixed_font());
        show_wrapped(command, ImGui::GetStyleColorVec4(ImGuiCol_Text));
        ImGui::PopFont();
    }
    if (std::string edits = unsaved_edits(context.session, context.ui.window.opened); !edits.empty())
        show_wrapped(edits, k_warning_colour);
}

void draw_preset(PanelContext& context) {
    static std::string name;
    static bool overwrite = false;
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##preset", "name of a new graph", &name);
    note_widget("capture.preset");
    help("It goes to the assets' graphs, or to a path when it is one.");
    ImGui::BeginDisabled(name.empty());
    if (ImGui::Button("save values as graph")) {
        context.ui.window.ask([&session = context.session, &ui = context.ui, file = name, replace = overwrite] {
            ui.say("saved " + save_graph_preset(session, file, replace).string());
        });
        overwrite = false;
    }
    ImGui::EndDisabled();
    note_widget("capture.save_preset");
    help("A graph that extends this one by the values of the panels.");
    ImGui::SameLine();
    ImGui::Checkbox("overwrite", &overwrite);
}

} // namespace

void draw_capture_panel(PanelContext& context) {
    ImGui::PushID("capture");
    if (ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) draw_pictures(context);
    if (ImGui::CollapsingHeader("Recording", ImGuiTreeNodeFlags_DefaultOpen)) draw_sequence(context);
    if (ImGui::CollapsingHeader("Make it again", ImGuiTreeNodeFlags_DefaultOpen)) draw_reproduction(context);
    if (ImGui::CollapsingHeader("Graph preset", ImGuiTreeNodeFlags_DefaultOpen)) draw_preset(context);
    ImGui::PopID();
}

} // namespace bounce
