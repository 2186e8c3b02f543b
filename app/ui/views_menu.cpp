#include "app/ui/views_menu.h"

#include "app/debug_views.h"
#include "app/ui/marks.h"
#include "app/ui/pinned_rays.h"
#include "app/ui/texture_view.h"
#include "app/ui/viewed.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

/// Found once for a plan.
const std::vector<DebugView>& views_of(const Session& session) {
    static std::vector<DebugView> views;
    static const GraphModel* model = nullptr;
    static uint64_t plans = 0;
    const Graph& graph = session.graph();
    if (model != &graph.model() || plans != graph.plans()) {
        model = &graph.model(), plans = graph.plans();
        views = debug_views(graph.model(), session.facts(), session.size());
    }
    return views;
}

/// Passes that were switched on to look at what they draw.
std::vector<std::string>& switched_on() {
    static std::vector<std::string> passes;
    return passes;
}

void show_view(PanelContext& context, const std::string& resource, const std::string& pass) {
    Session& session = context.session;
    GraphModel& model = session.graph().model();
    for (const std::string& id : std::exchange(switched_on(), {}))
        if (PassNode* node = model.find_node(id)) node->enabled = false;
    if (!pass.empty() && model.find_node(pass)) {
        switched_on() = model.off_before(pass);
        model.switch_pass(pass, true);
    }
    session.graph().prepare(session.facts(), session.size());
    pin(context.ui, session.graph(), resource);
    context.ui.redraw();
    const PlanResource* made = session.graph().plan().find_resource(resource);
    if (made && !made->is_buffer()) {
        // The middle of a volume tells more than its rim.
        if (made->texture.kind == TextureKind::texture_3d) context.ui.viewer.layer = made->texture.size.z / 2;
        return;
    }
    for (const PlanSkip& skip : session.graph().plan().skipped)
        if (skip.id == pass) context.ui.say(resource + " is not made: " + pass + " is skipped: " + skip.reason, true);
}

void entry(PanelContext& context, const std::string& resource, const std::string& pass, const std::string& name,
           const std::string& about) {
    const bool chosen = context.ui.pinned == resource;
    ImGui::PushID(resource.c_str());
    if (ImGui::MenuItem(name.c_str(), nullptr, chosen)) ask_for_view(context, resource, pass);
    note_widget("views." + (resource.empty() ? std::string("final") : resource));
    show_tooltip(about);
    ImGui::PopID();
}

/// The textures whose names begin so.
void entries(PanelContext& context, const char* title, const std::function<bool(const std::string&)>& wanted) {
    bool first = true;
    for (const PlanResource& resource : context.session.graph().plan().resources) {
        if (resource.is_buffer() || !wanted(resource.name())) continue;
        if (std::exchange(first, false)) show_text(title, k_dim_colour);
        std::string about =
            resource.name() + ", written by " + (resource.writers.empty() ? "nobody" : resource.writers.front());
        entry(context, resource.name(), "", resource.name(), about);
    }
}

void draw_list(PanelContext& context) {
    entry(context, "", "", "final picture", "out.display. Key: Escape");
    const auto& views = views_of(context.session);
    if (!views.empty()) show_text("structures of this graph", k_dim_colour);
    for (const DebugView& view : views)
        entry(context, view.resource, view.pass, view.name, view.about + "\nDrawn by " + view.pass + ".");
    const auto starts = [](const char* with) {
        return [with](const std::string& name) { return name.starts_with(with); };
    };
    entries(context, "light",
            [](const std::string& name) { return name.starts_with("out.") && name != "out.display"; });
    entries(context, "surfaces", starts("gbuffer."));
    if (!ImGui::BeginMenu("all other textures")) return;
    entries(context, "", [](const std::string& name) {
        return !name.starts_with("out.") && !name.starts_with("gbuffer.") && !name.starts_with("debug.");
    });
    ImGui::EndMenu();
}

std::string short_number(float value) {
    return fmt::format("{:.4g}", value);
}

/// What a value of the texture is measured in; empty: it is a number.
std::string unit_of(const PlanResource& resource) {
    if (resource.declaration.radiance) return "W/(sr·m²)";
    if (resource.name().ends_with("depth")) return "depth as it is stored";
    return {};
}

/// Dark to bright from left to right, with the values at its ends and its middle.
void draw_bar(ImVec2 at, float width, const ViewerSettings& shown, glm::vec2 range, const std::string& unit) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    constexpr int steps = 40;
    for (int i = 0; i < steps; ++i) {
        const float share = (float(i) + 0.5f) / steps;
        glm::vec3 colour = heat_colour(share);
        if (!shown.false_colour) colour = glm::vec3(shown.encode_srgb ? std::pow(share, 1 / 2.2f) : share);
        const ImU32 packed = ImGui::GetColorU32({colour.r, colour.g, colour.b, 1});
        list.AddRectFilled({at.x + width * float(i) / steps, at.y},
                           {at.x + width * float(i + 1) / steps, at.y + 0.8f * font}, packed);
    }
    list.AddRect(at, {at.x + width, at.y + 0.8f * font}, IM_COL32(160, 160, 160, 255));
    float middle = 0.5f * (range.x + range.y);
    if (shown.logarithmic) middle = std::sqrt(std::max(range.x, range.y * 1e-6f) * range.y);
    const std::string ends[] = {short_number(range.x), short_number(middle),
                                short_number(range.y) + (unit.empty() ? "" : " " + unit)};
    for (int i = 0; i < 3; ++i) {
        const float text = ImGui::CalcTextSize(ends[i].c_str()).x;
        const float x = at.x + width * 0.5f * float(i) - (i == 1 ? 0.5f * text : i == 2 ? text : 0);
        list.AddText({std::max(x, at.x), at.y + 0.9f * font}, IM_COL32(230, 230, 230, 255), ends[i].c_str());
    }
}

std::string channel_text(const ViewerSettings& shown, const PlanResource& resource) {
    static constexpr const char* k_names[] = {"", "red", "green", "blue", "alpha", "length of RGB"};
    const int channels = format_by_enum(resource.texture.format).channels;
    if (shown.channel > 0) return k_names[shown.channel];
    if (channels == 1) return "";
    if (shown.false_colour) return "luminance";
    return resource.name().ends_with("normal") ? "x, y, z as red, green, blue" : "";
}

} // namespace

void ask_for_view(PanelContext& context, const std::string& resource, const std::string& pass) {
    context.ui.window.ask([context, resource, pass]() mutable { show_view(context, resource, pass); });
}

void draw_views_menu(PanelContext& context, const Area& area) {
    if (!area.visible()) return;
    const float margin = ImGui::GetFontSize() * 0.5f;
    ImGui::SetNextWindowPos({area.min.x + area.size.x - margin, area.min.y + margin}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowBgAlpha(0.6f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {2, 2});
    ImGui::Begin("##views", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PopStyleVar();
    keep_over_picture();
    const std::string& pinned = context.ui.pinned;
    if (ImGui::Button(fmt::format("view: {}###open", pinned.empty() ? "final picture" : pinned).c_str()))
        ImGui::OpenPopup("list");
    note_widget("views.open");
    ViewerSettings& viewer = context.ui.viewer;
    const GpuTexture* texture = pinned.empty() ? nullptr : context.session.graph().texture(pinned);
    if (texture && viewer.resource == pinned) {
        ImGui::SameLine();
        if (ImGui::Checkbox("false colour", &viewer.false_colour)) {
            viewer.automatic_range = viewer.automatic_range || viewer.false_colour;
            context.ui.redraw();
        }
        note_widget("views.false_colour");
        show_tooltip("One number per texel as a colour, over the range that is found.");
        const glm::vec3 mine(texture->desc().size), whole(glm::vec2(context.session.size()), 1);
        if (std::abs(mine.x / mine.y - whole.x / whole.y) < 0.05f) {
            ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
            ImGui::SameLine();
            ImGui::SliderFloat("##over", &viewer.over_picture, 0, 1, "over picture %.2f");
            note_widget("views.over_picture");
            show_tooltip("1: alone. Less: over the final picture.");
        }
    }
    draw_pin_buttons(context, pinned);
    if (ImGui::BeginPopup("list")) {
        draw_list(context);
        ImGui::EndPopup();
    }
    ImGui::End();
}

void draw_legend(PanelContext& context, const Area& area, const ViewerSettings& shown) {
    const PlanResource* resource = context.session.graph().plan().find_resource(shown.resource);
    if (!resource || resource->is_buffer() || shown.resource == "out.display") return;
    const float font = ImGui::GetFontSize(), width = std::min(18 * font, area.size.x - 2 * font);
    if (width < 6 * font || area.size.y < 8 * font) return;
    std::string about;
    for (const DebugView& view : views_of(context.session))
        if (view.resource == shown.resource) about = view.about;
    const bool single =
        shown.false_colour || shown.channel > 0 || format_by_enum(resource->texture.format).channels == 1;
    const bool drawn = !about.empty() && !single; // colours of its own
    std::string what = about.empty() ? shown.resource : about;
    if (const std::string channel = channel_text(shown, *resource); !channel.empty()) what += "\n" + channel;
    if (!single && !drawn) {
        const std::string unit = unit_of(*resource);
        what += fmt::format("\ncolour from {} to {}{}", short_number(viewed().range.x), short_number(viewed().range.y),
                            unit.empty() ? "" : " " + unit);
    }
    const ImVec2 text = ImGui::CalcTextSize(what.c_str(), nullptr, false, width);
    const float height = text.y + (single ? 2.4f * font : 0.0f) + font;
    const ImVec2 min{area.min.x + area.size.x - width - 1.5f * font, area.min.y + 2.8f * font};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, {min.x + width + font, min.y + height}, IM_COL32(0, 0, 0, 170), 3);
    note_rectangle("legend", min.x, min.y, min.x + width + font, min.y + height);
    list.AddText(nullptr, 0, {min.x + 0.5f * font, min.y + 0.4f * font}, IM_COL32(230, 230, 230, 255), what.c_str(),
                 nullptr, width);
    if (single)
        draw_bar({min.x + 0.5f * font, min.y + text.y + 0.8f * font}, width, shown, viewed().range, unit_of(*resource));
}

} // namespace bounce
