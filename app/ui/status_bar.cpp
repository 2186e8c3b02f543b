#include "app/ui/status_bar.h"

#include "app/ui/settings_key.h"
#include "app/ui/style.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

/// "NVIDIA H100", "llvmpipe": without the driver's details, which the tooltip holds.
static std::string short_renderer(const std::string& renderer) {
    return renderer.substr(0, renderer.find_first_of("(/"));
}

/// The median of the last frames of the present settings; 0 while there is none.
static float recent_ms(const UiState& ui) {
    std::vector<float> last;
    for (auto frame = ui.frame_times.rbegin(); frame != ui.frame_times.rend() && last.size() < 20; ++frame)
        if (frame->current) last.push_back(frame->ms);
    if (last.empty()) return 0;
    auto middle = last.begin() + long(last.size() / 2);
    std::nth_element(last.begin(), middle, last.end());
    return *middle;
}

static void gap() {
    ImGui::SameLine(0, ImGui::GetFontSize());
}

static void draw_problems(PanelContext& context, size_t problems) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.55f, 0.12f, 0.10f, 1));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImVec4(0.70f, 0.16f, 0.13f, 1));
    if (ImGui::SmallButton(fmt::format("{} error{}", problems, problems == 1 ? "" : "s").c_str())) {
        context.ui.window.layout.show_right = true;
        context.ui.window.select_tab = "Shaders";
    }
    ImGui::PopStyleColor(2);
    note_widget("status.problems");
    help("Show the Shaders panel.");
    gap();
}

void draw_status_bar(PanelContext& context, const Area& area, const Capabilities& capabilities) {
    Session& session = context.session;
    UiState& ui = context.ui;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ImGui::GetFontSize() * 0.6f, ImGui::GetFontSize() * 0.3f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.10f, 0.10f, 0.10f, 1));
    begin_area("##status", area,
               ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);

    if (size_t problems = session.graph().problems().size()) draw_problems(context, problems);
    ImGui::TextColored(k_dim_colour, "%s", short_renderer(capabilities.renderer).c_str());
    help(describe(capabilities).c_str());
    gap();
    ImGui::Text("%d×%d", session.size().x, session.size().y);
    help("Size of the picture; the Camera panel sets it.");
    gap();
    float ms = recent_ms(ui);
    bool running = !ui.paused || ui.render_always || ui.window.capture.recording;
    if (ms <= 0)
        ImGui::TextColored(k_dim_colour, "- ms");
    else if (running)
        ImGui::Text("%.1f ms  %.0f fps", double(ms), 1000.0 / double(ms));
    else
        ImGui::Text("%.1f ms", double(ms));
    note_widget("status.frame_ms");
    help("Time of a whole frame, panels and display included.");
    gap();
    const bool current = times_are_current(session.graph());
    ImGui::TextColored(k_dim_colour, "passes %.2f ms%s", whole_frame_ms(session.graph()), current ? "" : " (old)");
    note_widget("status.passes_ms");
    help(current ? "GPU time of a frame in which all passes run: the sum of their medians since something was changed."
                 : "GPU time of earlier settings: the present ones have not been measured yet.");
    gap();
    if (ui.mid_frame) {
        ImGui::TextColored(k_accent_colour, "%2.0f %%", double(100 * ui.frame_share));
        note_widget("status.frame_share");
        help("Passes of the present frame that are done. What changes the graph takes effect at its end.");
        gap();
    }
    const char* state = ui.window.capture.recording ? "recording"
                        : !ui.paused                ? "playing"
                        : ui.render_always          ? "rendering"
                                                    : "paused";
    ImGui::TextColored(ui.paused && !ui.render_always ? k_dim_colour : k_accent_colour, "%s", state);
    gap();
    ImGui::TextColored(k_dim_colour, "frame %d", session.frame());
    if (ui.cursor_pixel.x >= 0) {
        gap();
        ImGui::TextColored(k_dim_colour, "pixel %d, %d", ui.cursor_pixel.x, ui.cursor_pixel.y);
    }

    // The notice takes what is left, cut short where it must be; a click shows the log.
    gap();
    float keys = ImGui::CalcTextSize("? keys").x + ImGui::GetFontSize();
    float available = ImGui::GetContentRegionAvail().x - keys;
    if (available > 40 && !ui.notice.empty()) {
        std::string line = ui.notice.substr(0, ui.notice.find('\n'));
        if (line.size() < ui.notice.size()) line += " …";
        ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::PushClipRect(at, {at.x + available, at.y + ImGui::GetTextLineHeightWithSpacing()}, true);
        ImGui::TextColored(ui.notice_is_error ? k_error_colour : k_good_colour, "%s", line.c_str());
        ImGui::PopClipRect();
        help(ui.notice.c_str());
        if (ImGui::IsItemClicked()) toggle_bottom(ui.window, "Log");
    }
    ImGui::SameLine(area.size.x - keys);
    if (ImGui::SmallButton("? keys")) ui.show_keys = !ui.show_keys;
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

} // namespace bounce
