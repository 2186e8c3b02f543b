// What a gather does at the pixel under the pointer: of cones a row a cone, and a row a sphere of the chosen one; rays
// are drawn only.
#include "app/panels/cones_panel.h"

#include "app/panels/panel.h"
#include "app/ui/marks.h"
#include "app/ui/texture_view.h"
#include "app/ui/widget_rects.h"
#include "core/error.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace bounce {

bool ConesState::follow(const Buffer& cones, uint64_t frame) {
    if (readback.arrived() && readback.data().size() >= sizeof records) {
        std::memcpy(&records, readback.data().data(), sizeof records);
        spheres.resize((readback.data().size() - sizeof records) / sizeof(RecordedSphere));
        std::memcpy(spheres.data(), readback.data().data() + sizeof records, spheres.size() * sizeof(RecordedSphere));
    }
    if (asked != frame && !readback.pending()) {
        readback.request(cones);
        asked = frame;
    }
    return readback.pending();
}

namespace {

/// Passes that record what a gather does at one pixel and draw it.
struct Inspection {
    const char *inspect, *view, *resource;
};
constexpr Inspection k_inspections[] = {{"inspect", "view_cones", "debug.cones_view"},
                                        {"inspect", "view_rays", "debug.rays_view"},
                                        {"inspect_fan", "view_fan", "debug.vf_fan"}};

/// Null where the graph has none.
const Inspection* inspection_of(const GraphModel& model) {
    for (const Inspection& known : k_inspections)
        if (model.find_node(known.inspect) && model.find_node(known.view)) return &known;
    return nullptr;
}

void switch_views(PanelContext& context, const Inspection& of, bool on) {
    context.ui.change_graph([&session = context.session, &ui = context.ui, &of, on] {
        for (const char* id : {of.inspect, of.view})
            session.graph().model().switch_pass(id, on);
        ui.redraw();
    });
}

void draw_switches(PanelContext& context, const Inspection& of, bool on) {
    if (ImGui::Checkbox("follow the pointer", &on)) switch_views(context, of, on);
    note_widget("cones.on");
    show_tooltip(
        "Switches on the passes that record the gather at a pixel and draw it. The Pixel tab's hold, or its key, "
        "keeps the pixel.");
    if (!on) return;
    ImGui::SameLine();
    bool shown = context.ui.pinned == of.resource;
    if (ImGui::Checkbox("draw them", &shown)) pin(context.ui, context.session.graph(), shown ? of.resource : "");
    note_widget("cones.draw");
    show_tooltip(fmt::format("Shows {}. Its parameters are those of {}.", of.resource, of.view));
}

/// The pointer's pixel becomes the pass's parameter; the frame that is rendered next records its cones.
void send_pixel(PanelContext& context, const Inspection& of) {
    UiState& ui = context.ui;
    Session& session = context.session;
    glm::ivec2 size = session.graph().plan().size;
    bool inside = ui.cursor_pixel.x >= 0 && ui.cursor_pixel.y >= 0 && glm::all(glm::lessThan(ui.cursor_pixel, size));
    if (!inside || ui.mid_frame) return;
    glm::vec2 place = (glm::vec2(ui.cursor_pixel) + 0.5f) / glm::vec2(size);
    Parameter& parameter = session.graph().model().parameter(fmt::format("{}.pixel", of.inspect));
    std::string text = fmt::format("{:.6g},{:.6g}", place.x, place.y);
    if (to_text(parameter.info, parameter.value) == text) return;
    session.set_parameter(fmt::format("{}.pixel", of.inspect), text, ParameterOrigin::panel);
    ui.redraw();
}

std::string colour_text(const glm::vec3& c) {
    return fmt::format("{:.3g}, {:.3g}, {:.3g}", c.x, c.y, c.z);
}

void cell(const std::string& text, const ImVec4* colour = nullptr) {
    ImGui::TableNextColumn();
    if (colour)
        show_text(text, *colour);
    else
        show_text(text);
}

bool begin_table(const char* name, std::initializer_list<const char*> columns, float height) {
    ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX |
                            ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable(name, int(columns.size()), flags, ImVec2(0, height))) return false;
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const char* column : columns)
        ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    return true;
}

/// `scale`: 1 ÷ pre-exposure, as for all light that is read from the GPU.
void draw_cones(ConesState& state, float height, float scale) {
    if (!begin_table("cones", {"cone", "weight", "occlusion", "radiance", "spheres", "length (m)", "direction"},
                     height))
        return;
    for (int i = 0; i < state.records.inspected.cones; ++i) {
        const RecordedCone& cone = state.records.cones[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (ImGui::Selectable(fmt::format("{}", i).c_str(), state.chosen == i, ImGuiSelectableFlags_SpanAllColumns))
            state.chosen = i;
        note_widget(fmt::format("cones.cone.{}", i));
        cell(fmt::format("{:.4f}", cone.weight));
        cell(fmt::format("{:.3f}", cone.occlusion));
        cell(colour_text(cone.radiance * scale));
        cell(cone.kept == cone.spheres ? fmt::format("{}", cone.spheres)
                                       : fmt::format("{} of {}", cone.kept, cone.spheres));
        cell(fmt::format("{:.3f}", cone.end));
        cell(fmt::format("{:.2f}, {:.2f}, {:.2f}", cone.direction.x, cone.direction.y, cone.direction.z));
    }
    ImGui::EndTable();
}

void draw_spheres(const ConesState& state, const LoadedSpace& space, float height, float scale) {
    if (!begin_table("spheres",
                     {"t (m)", "diameter", "occlusion", "share", "voxel mip", "map mip", "layers", "radiance"}, height))
        return;
    const RecordedCone& cone = state.records.cones[state.chosen];
    for (int i = 0; i < cone.kept && size_t(cone.first + i) < state.spheres.size(); ++i) {
        const RecordedSphere& sphere = state.spheres[size_t(cone.first + i)];
        if (state.only_hits && sphere.alpha <= 1e-3f) continue;
        const ImVec4* colour = sphere.at_hit ? &k_accent_colour : sphere.alpha <= 1e-3f ? &k_dim_colour : nullptr;
        ImGui::TableNextRow();
        cell(fmt::format("{:.4f}", sphere.t), colour);
        if (i == 0) note_widget("cones.sphere.0");
        const glm::dvec3 at = space.to_file(sphere.centre);
        show_tooltip(fmt::format("at {:.4f}, {:.4f}, {:.4f}{}", at.x, at.y, at.z,
                                 sphere.at_hit ? "\nthe lookup where the cone is blocked" : ""));
        cell(fmt::format("{:.4f}", sphere.diameter), colour);
        cell(fmt::format("{:.3f}", sphere.alpha), colour);
        cell(fmt::format("{:.3f}", sphere.share), colour);
        cell(fmt::format("{:.2f}", sphere.voxel_level), colour);
        cell(sphere.layers ? fmt::format("{:.2f}", sphere.map_level) : "", colour);
        cell(sphere.layers ? fmt::format("{}", sphere.layers) : "", colour);
        cell(sphere.radiance == glm::vec3(0) ? "" : colour_text(sphere.radiance * scale), colour);
    }
    ImGui::EndTable();
}

} // namespace

void draw_cones_panel(PanelContext& context) {
    UiState& ui = context.ui;
    const Graph& graph = context.session.graph();
    const Inspection* of = inspection_of(graph.model());
    if (!of) {
        show_wrapped("This graph has no passes that record what its gather does at a pixel.", k_dim_colour);
        return;
    }
    const bool on = graph.model().find_node(of->inspect)->enabled;
    draw_switches(context, *of, on);
    if (!on) return;
    send_pixel(context, *of);
    const Buffer* buffer = graph.buffer("debug.cones");
    if (!buffer) return show_wrapped("Its rays can be drawn; only cones are listed here.", k_dim_colour);
    if (!ui.cones) ui.cones = std::make_shared<ConesState>();
    ConesState& state = *ui.cones;
    if (state.follow(*buffer, graph.frames())) ui.redraw_panels = true;

    const InspectedPixel& at = state.records.inspected;
    if (at.cones <= 0) {
        show_text(state.spheres.empty() ? "point at the picture" : "background", k_dim_colour);
        return;
    }
    state.chosen = std::clamp(state.chosen, 0, std::min(at.cones, k_max_recorded_cones) - 1);
    show_text(fmt::format("pixel {}, {}", at.pixel.x, at.pixel.y), k_dim_colour);
    const float scale = 1 / context.session.constants().pre_exposure;
    show_text(fmt::format("E/π {}   occlusion {:.3f}", colour_text(glm::vec3(at.summed) * scale), 1 - at.summed.w),
              k_accent_colour);
    show_tooltip(
        fmt::format("The sum of the cones below.\nThe gather stored {}.", colour_text(glm::vec3(at.gathered) * scale)));
    float height = ImGui::GetContentRegionAvail().y - 2 * ImGui::GetFrameHeightWithSpacing();
    draw_cones(state, std::max(0.4f * height, 5 * ImGui::GetTextLineHeightWithSpacing()), scale);
    show_text(fmt::format("spheres of cone {}", state.chosen));
    ImGui::SameLine();
    ImGui::Checkbox("only with occlusion", &state.only_hits);
    note_widget("cones.only_hits");
    draw_spheres(state, context.session.shot().scene.space,
                 std::max(0.6f * height, 5 * ImGui::GetTextLineHeightWithSpacing()), scale);
}

} // namespace bounce
