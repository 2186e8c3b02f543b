#include "app/ui/viewport.h"

#include "app/hosts/window.h"
#include "app/ui/live_comparison.h"
#include "app/ui/pinned_rays.h"
#include "app/ui/snapshots.h"
#include "app/ui/style.h"
#include "app/ui/viewed.h"
#include "app/ui/views_menu.h"
#include "app/ui/widget_rects.h"
#include "core/problem.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

void Viewport::release_gpu() {
    view_.reset();
    pair_ = nullptr;
    drawn_texture_ = 0;
    drawn_frame_ = ~0ull;
}

const GpuTexture* Viewport::texture_to_show(PanelContext& context) {
    const Graph& graph = context.session.graph();
    bool plain = context.ui.hovered.empty() && context.ui.pinned.empty();
    // Half a frame is no picture to compare.
    if (context.ui.mid_frame && plain && pair_) return pair_;
    pair_ = nullptr;
    caption_.clear();
    if (context.ui.comparison && plain && !context.ui.mid_frame) {
        try {
            const double now = ImGui::GetTime();
            if (const GpuTexture* pair = context.ui.comparison->picture(context.session, now)) {
                caption_ = context.ui.comparison->caption(context.session, now);
                shown_ = {};
                drawn_frame_ = ~0ull;
                failure_.clear();
                return pair_ = pair;
            }
        } catch (const std::exception& problem) {
            context.ui.say(problem_text(problem), true); // the graph's own picture is shown instead
        }
    }
    ViewerSettings settings = shown_view(graph, context.ui);
    const GpuTexture* source = settings.resource.empty() ? nullptr : graph.texture(settings.resource);
    if (!source || !*source) {
        failure_ = "the graph makes no out.display";
        shown_ = settings;
        return nullptr;
    }
    bool current = view_ && settings == shown_ && drawn_frame_ == graph.frames() && drawn_texture_ == source->id();
    const bool counted = !viewed().wants_histogram || !viewed().histogram.empty();
    if (current && !counted) note_viewed(*source, settings);
    if (current) return failure_.empty() ? &view_->picture() : nullptr;
    shown_ = settings;
    drawn_frame_ = graph.frames();
    drawn_texture_ = source->id();
    try {
        if (!view_) view_ = std::make_unique<TextureView>();
        view_->draw(*source, settings, context.session.value_scale(settings.resource));
        note_viewed(*source, settings);
        failure_.clear();
        return &view_->picture();
    } catch (const std::exception& problem) {
        failure_ = problem_text(problem);
        return nullptr;
    }
}

/// For the legend and the histogram of what is shown; the final picture has neither.
void Viewport::note_viewed(const GpuTexture& source, const ViewerSettings& settings) {
    Viewed& found = viewed();
    found.resource = settings.resource;
    found.histogram.clear();
    found.range = {settings.low, settings.high};
    if (settings.resource == "out.display") return;
    if (settings.automatic_range) found.range = view_->range();
    if (!found.wants_histogram) return;
    found.histogram = view_->histogram(source, settings);
    found.above = found.histogram.back(), found.histogram.pop_back();
    found.below = found.histogram.back(), found.histogram.pop_back();
}

Area Viewport::place_picture(const PanelContext& context, const Area& area, glm::vec2 texels) const {
    const WindowState& window = context.ui.window;
    glm::vec2 available(area.size.x, area.size.y);
    float scale = std::min(available.x / texels.x, available.y / texels.y);
    float fill = std::abs(texels.x / texels.y * (available.y / available.x) - 1);
    // A picture made for this area fills it; others are magnified by whole numbers, so that texels look alike.
    if (fill > 0.01f && scale > 1) scale = std::floor(scale);
    glm::vec2 size = fill <= 0.01f ? available : texels * scale;
    size *= window.image_zoom;
    glm::vec2 centre = window.image_zoom > 1 ? window.image_centre : glm::vec2(0.5f);
    glm::vec2 min = glm::vec2(area.min.x, area.min.y) + glm::round(0.5f * available - centre * size);
    return {{min.x, min.y}, {size.x, size.y}};
}

void Viewport::zoom(PanelContext& context, const Area& area, const Area& picture) const {
    WindowState& window = context.ui.window;
    const ImGuiIO& io = ImGui::GetIO();
    glm::vec2 mouse(io.MousePos.x, io.MousePos.y), min(picture.min.x, picture.min.y),
        size(picture.size.x, picture.size.y);
    float before = window.image_zoom;
    float after = std::clamp(before * std::pow(1.25f, io.MouseWheel), 1.0f, 64.0f);
    if (after < 1.1f) after = 1;
    // The place under the pointer stays there.
    glm::vec2 uv = (mouse - min) / size;
    glm::vec2 middle = glm::vec2(area.min.x, area.min.y) + 0.5f * glm::vec2(area.size.x, area.size.y);
    glm::vec2 centre = uv - (mouse - middle) / (size * (after / before));
    window.image_zoom = after;
    window.image_centre = glm::clamp(centre, glm::vec2(0), glm::vec2(1));
}

void Viewport::follow_pointer(PanelContext& context, const Area& picture, bool hovered) const {
    UiState& ui = context.ui;
    if (ui.cursor_locked) return;
    glm::vec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    glm::vec2 uv = (mouse - glm::vec2(picture.min.x, picture.min.y)) / glm::vec2(picture.size.x, picture.size.y);
    bool inside = hovered && uv.x >= 0 && uv.y >= 0 && uv.x < 1 && uv.y < 1;
    ui.cursor_uv = inside ? uv : glm::vec2(-1);
    ui.cursor_pixel = glm::ivec2(-1);
    glm::ivec2 size = context.session.size();
    if (inside) ui.cursor_pixel = glm::min(glm::ivec2(glm::floor(uv * glm::vec2(size))), size - 1);
}

void Viewport::move_camera(PanelContext& context, const Area& picture, bool hovered, bool active, bool pressed,
                           Window& window) {
    const ImGuiIO& io = ImGui::GetIO();
    if (pressed) {
        for (int button : {0, 1, 2}) {
            if (io.MouseDown[button]) drag_button_ = button;
        }
    }
    if (!active) drag_button_ = -1;
    CameraInput input;
    input.hovered = hovered && !io.KeyCtrl;
    input.look = drag_button_ == 1;
    input.turn = drag_button_ == 0;
    input.slide = drag_button_ == 2;
    glm::vec2 scale = glm::vec2(context.session.size()) / glm::vec2(picture.size.x, picture.size.y);
    // The way to where a drag begins is no part of it.
    if (!pressed) input.moved = glm::vec2(io.MouseDelta.x, io.MouseDelta.y) * scale;
    input.pixel = (glm::vec2(io.MousePos.x, io.MousePos.y) - glm::vec2(picture.min.x, picture.min.y)) * scale;
    input.wheel = hovered || active ? io.MouseWheel : 0;
    if (io.KeyCtrl) input.wheel = 0;
    input.seconds = std::min(io.DeltaTime, 0.1f);
    if (input.look) {
        input.forward = window.place_is_down('W'), input.back = window.place_is_down('S');
        input.left = window.place_is_down('A'), input.right = window.place_is_down('D');
        input.down = window.place_is_down('Q'), input.up = window.place_is_down('E');
        input.fast = io.KeyShift;
    }
    window.capture_pointer(input.look);
    bool flying = input.forward || input.back || input.left || input.right || input.up || input.down;
    // The next frame goes on from here without waiting for an event.
    busy_ = control_.update(context, input) || flying;
}

/// Two snapshots, or one and the present picture, in the place of it. Returns whether that was drawn.
bool Viewport::draw_snapshots(PanelContext& context, const Area& picture) {
    Snapshots* snapshots = context.ui.snapshots.get();
    const bool plain = context.ui.hovered.empty() && context.ui.pinned.empty();
    if (!snapshots || snapshots->view == SnapshotView::off || !plain) return false;
    const auto side = [&](int index) {
        const GpuTexture* frozen = snapshots->texture(index);
        return frozen ? frozen : context.session.graph().texture("out.display");
    };
    const auto name = [&](int index) {
        return index < 0 ? std::string("the picture now") : snapshots->all[size_t(index)].name;
    };
    const GpuTexture *left = side(snapshots->left), *right = side(snapshots->right);
    if (!left || !right) return false;
    float share = snapshots->view == SnapshotView::one ? 1 : snapshots->wipe;
    if (snapshots->view == SnapshotView::flicker) share = std::fmod(ImGui::GetTime(), 1.0) < 0.5 ? 1.0f : 0.0f;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float middle = picture.min.x + share * picture.size.x, bottom = picture.min.y + picture.size.y;
    const auto image = [](const GpuTexture& of) {
        return reinterpret_cast<ImTextureID>(static_cast<intptr_t>(of.id()));
    };
    list->AddImage(image(*left), picture.min, {middle, bottom}, {0, 0}, {share, 1});
    list->AddImage(image(*right), {middle, picture.min.y}, {picture.min.x + picture.size.x, bottom}, {share, 0},
                   {1, 1});
    const bool both = snapshots->view == SnapshotView::wipe;
    if (both) list->AddLine({middle, picture.min.y}, {middle, bottom}, IM_COL32(255, 255, 255, 160));
    caption_ = share >= 1   ? name(snapshots->left)
               : share <= 0 ? name(snapshots->right)
                            : name(snapshots->left) + "  |  " + name(snapshots->right);
    return true;
}

static void label(ImVec2 at, const std::string& text, ImVec4 colour) {
    ImVec2 size = ImGui::CalcTextSize(text.c_str());
    float pad = ImGui::GetFontSize() * 0.4f;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, {at.x + size.x + 2 * pad, at.y + size.y + pad}, IM_COL32(0, 0, 0, 170), 3);
    list->AddText({at.x + pad, at.y + 0.5f * pad}, ImGui::GetColorU32(colour), text.c_str());
}

void Viewport::overlay(PanelContext& context, const Area& area, const Area& picture) const {
    const UiState& ui = context.ui;
    ImDrawList* list = ImGui::GetWindowDrawList();
    float margin = ImGui::GetFontSize() * 0.5f;
    std::string text = caption_;
    if (!shown_.resource.empty() && shown_.resource != "out.display") {
        const TextureDesc& desc = context.session.graph().texture(shown_.resource)->desc();
        glm::ivec3 size = mip_size(desc, shown_.mip);
        text = fmt::format("{}   {}×{}", shown_.resource, size.x, size.y);
        if (desc.mips > 1) text += fmt::format("   mip {}", shown_.mip);
        if (size.z > 1)
            text += fmt::format("   {} {} of {}", desc.kind == TextureKind::texture_3d ? "slice" : "layer",
                                shown_.layer, size.z);
        text += fmt::format("   {}", format_by_enum(desc.format).name);
        if (ui.hovered.empty()) text += "   (Escape: the final picture)";
    }
    if (ui.window.image_zoom > 1)
        text += fmt::format("{}×{:.3g} (Ctrl+0)", text.empty() ? "" : "   ", ui.window.image_zoom);
    if (!text.empty()) label({area.min.x + margin, area.min.y + margin}, text, {1, 1, 1, 1});
    if (ui.window.capture.recording) {
        std::string recording = fmt::format("● recording  {}", ui.window.capture.written);
        ImVec2 size = ImGui::CalcTextSize(recording.c_str());
        label({area.min.x + 0.5f * (area.size.x - size.x), area.min.y + margin}, recording, k_error_colour);
    }
    glm::ivec2 size = context.session.size();
    auto on_screen = [&](glm::vec2 pixel) {
        return ImVec2(picture.min.x + pixel.x / float(size.x) * picture.size.x,
                      picture.min.y + pixel.y / float(size.y) * picture.size.y);
    };
    if (ui.cursor_locked && ui.cursor_pixel.x >= 0) {
        glm::vec2 pixel(ui.cursor_pixel);
        ImVec2 a = on_screen(pixel), b = on_screen(pixel + 1.0f);
        list->AddRect({a.x - 3, a.y - 3}, {b.x + 3, b.y + 3}, IM_COL32(0, 0, 0, 255));
        list->AddRect({a.x - 2, a.y - 2}, {b.x + 2, b.y + 2}, IM_COL32(255, 255, 255, 255));
    }
    if (const std::optional<glm::vec3>& pivot = control_.pivot()) {
        FrameConstants view;
        set_camera(view, context.session.camera(), size, 1);
        glm::vec4 clip = view.view_projection * glm::vec4(*pivot, 1);
        if (clip.w > 0) {
            // The projection has row 0 at the top already.
            ImVec2 at = on_screen((glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(size));
            list->AddCircle(at, 5, IM_COL32(0, 0, 0, 200), 0, 3);
            list->AddCircle(at, 5, ImGui::GetColorU32(k_accent_colour), 0, 1.5f);
        }
    }
}

void Viewport::draw(PanelContext& context, const Area& area, Window& window) {
    const GpuTexture* texture = texture_to_show(context);
    glm::vec2 texels = texture ? glm::vec2(texture->desc().size) : glm::vec2(context.session.size());
    Area picture = place_picture(context, area, texels);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.085f, 0.085f, 0.085f, 1));
    begin_area(k_picture_window, area,
               ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
    ImGui::SetCursorScreenPos(area.min);
    ImGui::InvisibleButton("picture", area.size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    // A click takes the keyboard from a text field, so that keys mean the viewport again.
    if (ImGui::IsItemActivated()) ImGui::SetWindowFocus();
    follow_pointer(context, picture, hovered);
    if (hovered && ImGui::GetIO().KeyCtrl && ImGui::GetIO().MouseWheel != 0) zoom(context, area, picture);
    const bool pressed = ImGui::IsItemActivated();

    ImDrawList* list = ImGui::GetWindowDrawList();
    if (draw_snapshots(context, picture)) {
        shown_ = {};
        drawn_frame_ = ~0ull;
    } else if (texture) {
        const ImVec2 end{picture.min.x + picture.size.x, picture.min.y + picture.size.y};
        const auto image = [](const GpuTexture& of) {
            return reinterpret_cast<ImTextureID>(static_cast<intptr_t>(of.id()));
        };
        const GpuTexture* final_picture = context.session.graph().texture("out.display");
        const bool over = shown_.over_picture < 1 && shown_.resource != "out.display" && final_picture;
        if (over) list->AddImage(image(*final_picture), picture.min, end);
        list->AddImage(image(*texture), picture.min, end, {0, 0}, {1, 1},
                       IM_COL32(255, 255, 255, over ? int(255 * shown_.over_picture) : 255));
    } else {
        ImGui::SetCursorScreenPos({area.min.x + 20, area.min.y + 20});
        ImGui::PushTextWrapPos(area.size.x - 20);
        ImGui::TextColored(k_error_colour, "%s", failure_.c_str());
        ImGui::PopTextWrapPos();
    }
    note_rectangle("viewport", picture.min.x, picture.min.y, picture.min.x + picture.size.x,
                   picture.min.y + picture.size.y);
    draw_pinned_rays(context, picture);
    const bool taken = gizmo_.draw(context, picture, hovered, pressed, active);
    move_camera(context, picture, hovered && !taken, active && !taken, pressed && !taken, window);
    overlay(context, area, picture);
    if (caption_.empty()) draw_legend(context, area, shown_);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

} // namespace bounce
