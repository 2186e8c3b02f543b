// Exact values under the pointer: what is shown, every texture of the picture's size, the place in the world.
#include "app/panels/panel.h"
#include "app/ui/keys.h"
#include "app/ui/marks.h"
#include "app/ui/texel.h"
#include "app/ui/texture_view.h"
#include "app/ui/widget_rects.h"

#include <fmt/format.h>
#include <utility>

namespace bounce {

namespace {

/// Lines broken between values only: ImGui would break a number at its point.
std::string broken(const std::string& text, float width) {
    std::string out, line;
    for (size_t at = 0; at < text.size();) {
        size_t comma = text.find(", ", at);
        size_t end = comma == std::string::npos ? text.size() : comma + 2;
        std::string value = text.substr(at, end - at);
        if (!line.empty() && ImGui::CalcTextSize((line + value).c_str()).x > width)
            out += std::exchange(line, "") + "\n";
        line += value;
        at = end;
    }
    return out + line;
}

/// A name and a value; a click copies the value.
void draw_value(UiState& ui, const std::string& name, const std::string& text, const ImVec4& colour) {
    ImGui::PushID(name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
        ImGui::SetClipboardText(text.c_str());
        ui.say("copied: " + text);
    }
    note_widget("inspector." + name);
    show_tooltip(name + "\n" + text + "\nClick to copy.");
    ImGui::TableNextColumn();
    ImGui::PushFont(fixed_font());
    show_text(broken(text, ImGui::GetContentRegionAvail().x), colour);
    ImGui::PopFont();
    ImGui::PopID();
}

void draw_texel(UiState& ui, const std::string& name, const Texel& texel) {
    draw_value(ui, name, to_text(texel), is_finite(texel) ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : k_error_colour);
}

bool begin_values(const char* name) {
    if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return false;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 5);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 6);
    return true;
}

/// The texel of the texture in the viewport, at the mip and layer that it is shown with.
void draw_shown(PanelContext& context) {
    const Graph& graph = context.session.graph();
    ViewerSettings shown = shown_view(graph, context.ui);
    const GpuTexture* texture = shown.resource.empty() ? nullptr : graph.texture(shown.resource);
    if (!texture) return;
    glm::ivec3 size = mip_size(texture->desc(), shown.mip);
    glm::ivec2 at = texel_at(context.ui.cursor_uv, glm::ivec2(size));
    std::string place = fmt::format("texel {}, {}", at.x, at.y);
    if (size.z > 1)
        place +=
            fmt::format(", {} {}", texture->desc().kind == TextureKind::texture_3d ? "slice" : "layer", shown.layer);
    if (texture->desc().mips > 1) place += fmt::format(" of mip {}", shown.mip);
    show_text(shown.resource, k_accent_colour);
    ImGui::SameLine();
    show_text(place, k_dim_colour);
    if (!begin_values("shown")) return;
    Texel texel = read_texel(*texture, shown.mip, {at, shown.layer}, context.session.value_scale(shown.resource));
    static constexpr const char* k_channels[] = {"R", "G", "B", "A"};
    for (int c = 0; c < texel.channels; ++c) {
        Texel one{1, texel.integer, texel.digits, {texel.real[size_t(c)]}, {texel.whole[size_t(c)]}};
        draw_texel(context.ui, k_channels[c], one);
    }
    ImGui::EndTable();
}

std::string position_text(const glm::dvec3& p) {
    return fmt::format("{:.4f}, {:.4f}, {:.4f}", p.x, p.y, p.z);
}

void draw_world(PanelContext& context, glm::ivec2 pixel) {
    const Session& session = context.session;
    const GpuTexture* depth = session.graph().texture("gbuffer.depth");
    if (!depth || !begin_values("world")) return;
    const FrameConstants& constants = session.constants();
    const LoadedSpace& space = session.shot().scene.space;
    float stored = read_texel(*depth, 0, {pixel, 0}).real[0];
    if (auto position = world_position(constants, pixel, stored)) {
        ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_Text);
        draw_value(context.ui, "position (m)", position_text(space.to_file(*position)), colour);
        double distance = space.unit * glm::distance(*position, constants.camera_position);
        draw_value(context.ui, "distance (m)", fmt::format("{:.4f}", distance), colour);
    } else {
        draw_value(context.ui, "position (m)", "background", k_dim_colour);
    }
    ImGui::EndTable();
}

void draw_picture_textures(PanelContext& context, glm::ivec2 pixel) {
    const Graph& graph = context.session.graph();
    if (!begin_values("textures")) return;
    for (const PlanResource& resource : graph.plan().resources) {
        bool fits = !resource.is_buffer() && resource.texture.kind == TextureKind::texture_2d &&
                    glm::ivec2(resource.texture.size) == graph.plan().size;
        const GpuTexture* texture = fits ? graph.texture(resource.name()) : nullptr;
        if (texture) {
            float scale = context.session.value_scale(resource.name());
            draw_texel(context.ui, resource.name(), read_texel(*texture, 0, {pixel, 0}, scale));
        }
    }
    ImGui::EndTable();
}

} // namespace

void draw_inspector_panel(PanelContext& context) {
    UiState& ui = context.ui;
    glm::ivec2 size = context.session.graph().plan().size;
    bool inside =
        ui.cursor_pixel.x >= 0 && ui.cursor_pixel.y >= 0 && ui.cursor_pixel.x < size.x && ui.cursor_pixel.y < size.y;
    ImGui::Checkbox("hold", &ui.cursor_locked);
    note_widget("inspector.lock");
    show_tooltip("Keeps the pixel while the pointer goes elsewhere. Key: " + chord_of(KeyCommand::lock_cursor));
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    if (!inside) {
        show_text("point at the picture", k_dim_colour);
        return;
    }
    show_text(fmt::format("pixel {}, {}", ui.cursor_pixel.x, ui.cursor_pixel.y));
    ImGui::SameLine();
    show_text(fmt::format("of {}×{}", size.x, size.y), k_dim_colour);
    ImGui::Separator();
    draw_shown(context);
    ImGui::Separator();
    draw_world(context, ui.cursor_pixel);
    ImGui::Separator();
    draw_picture_textures(context, ui.cursor_pixel);
}

} // namespace bounce
