// The graph as boxes and wires: zoom, pan, cost of each pass, a click pins, a tick switches.
#include "app/panels/nodes_panel.h"

#include "app/panels/panel.h"
#include "app/panels/pass_switch.h"
#include "app/pass_rows.h"
#include "app/timings.h"
#include "app/ui/marks.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr float k_least_zoom = 0.05f, k_most_zoom = 3, k_most_fitting_zoom = 1;
constexpr float k_thumbnail = 16; // em

ImVec2 screen(glm::vec2 p) {
    return {p.x, p.y};
}

/// What the pointer is on.
struct Hit {
    int box = -1, output = -1;
    bool tick = false;
};

class NodesView {
  public:
    NodesView(PanelContext& context, NodesState& state)
        : context_(context), state_(state), graph_(context.session.graph()), list_(*ImGui::GetWindowDrawList()) {
        const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
        min_ = {at.x, at.y};
        size_ = glm::max(glm::vec2(room.x, room.y), glm::vec2(1));
    }

    void draw() {
        ImGui::InvisibleButton("canvas", screen(size_),
                               ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                                   ImGuiButtonFlags_MouseButtonRight);
        note_widget("nodes.canvas");
        const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive(), begun = ImGui::IsItemActivated(),
                   ended = ImGui::IsItemDeactivated();
        if (state_.whole) show_whole();
        if (hovered) take_wheel();
        em_ = ImGui::GetFontSize() * state_.zoom;
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const Hit hit = hovered ? hit_at({mouse.x, mouse.y}) : Hit();
        if (begun) state_.moved = 0;
        if (active) pan();
        if (ended && state_.moved < 4 && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) click(hit);
        list_.PushClipRect(screen(min_), screen(min_ + size_), true);
        draw_wires(hit);
        slowest_ = 0;
        for (const PlanPass& pass : graph_.plan().passes)
            slowest_ = std::max(slowest_, graph_.timing(pass.id).median);
        for (size_t i = 0; i < state_.layout.boxes.size(); ++i)
            draw_box(state_.layout.boxes[i], int(i) == hit.box, hit);
        list_.PopClipRect();
        if (hovered && !active) explain(hit);
    }

  private:
    glm::vec2 place(glm::vec2 em) const { return min_ + 0.5f * size_ + (em - state_.centre) * em_; }

    void show_whole() {
        const float font = ImGui::GetFontSize();
        const glm::vec2 wanted = (state_.layout.size + 2.0f) * font;
        state_.zoom = std::clamp(std::min(size_.x / wanted.x, size_.y / wanted.y), k_least_zoom, k_most_fitting_zoom);
        state_.centre = 0.5f * state_.layout.size;
    }

    /// The place under the pointer stays there.
    void take_wheel() {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.MouseWheel == 0) return;
        const glm::vec2 off = glm::vec2(io.MousePos.x, io.MousePos.y) - min_ - 0.5f * size_;
        const float before = ImGui::GetFontSize() * state_.zoom;
        state_.zoom = std::clamp(state_.zoom * std::pow(1.2f, io.MouseWheel), k_least_zoom, k_most_zoom);
        state_.centre += off / before - off / (ImGui::GetFontSize() * state_.zoom);
        state_.whole = false;
    }

    void pan() {
        const ImVec2 by = ImGui::GetIO().MouseDelta;
        state_.moved += std::abs(by.x) + std::abs(by.y);
        if (state_.moved < 4) return;
        state_.centre -= glm::vec2(by.x, by.y) / em_;
        state_.whole = false;
    }

    glm::vec2 tick_min(const LayoutBox& box) const { return place(box.min + glm::vec2(0.45f, 0.35f)); }
    float tick_side() const { return 0.95f * em_; }

    Hit hit_at(glm::vec2 mouse) const {
        Hit hit;
        for (size_t i = 0; i < state_.layout.boxes.size(); ++i) {
            const LayoutBox& box = state_.layout.boxes[i];
            const glm::vec2 min = place(box.min), max = place(box.min + box.size);
            if (mouse.x < min.x || mouse.y < min.y || mouse.x > max.x || mouse.y > max.y) continue;
            hit.box = int(i);
            const float row = ((mouse.y - min.y) / em_ - k_layout_head) / k_layout_row;
            if (row >= 0 && row < float(box.outputs.size())) hit.output = int(row);
            const glm::vec2 tick = tick_min(box);
            hit.tick = mouse.x >= tick.x && mouse.y >= tick.y && mouse.x < tick.x + tick_side() &&
                       mouse.y < tick.y + tick_side();
        }
        return hit;
    }

    void click(const Hit& hit) {
        if (hit.box < 0) return;
        UiState& ui = context_.ui;
        const LayoutBox& box = state_.layout.boxes[size_t(hit.box)];
        const PassNode* node = graph_.model().find_node(box.id);
        if (hit.tick) return switch_pass(context_, box.id, !(node && node->enabled));
        std::string resource = hit.output >= 0 ? box.outputs[size_t(hit.output)] : "";
        if (resource.empty() && box.plan >= 0)
            resource = main_output(graph_.plan(), graph_.plan().passes[size_t(box.plan)]);
        const PlanResource* known = graph_.plan().find_resource(resource);
        if (!known) return;
        if (known->is_buffer()) {
            ui.buffer = {resource, 0, ui.buffer.words};
            ui.window.layout.show_right = true;
            ui.window.select_tab = "Resources";
        } else {
            ui.buffer.resource.clear();
            pin(ui, graph_, ui.pinned == resource ? "" : resource);
        }
    }

    void draw_wires(const Hit& hit) {
        for (const bool front : {false, true}) {
            for (const LayoutWire& wire : state_.layout.wires) {
                const bool chosen = hit.box >= 0 &&
                                    (hit.output < 0 || hit.box != wire.from || hit.output == wire.output) &&
                                    (hit.box == wire.from || (hit.box == wire.to && hit.output < 0));
                if (chosen == front) draw_wire(wire, chosen);
            }
        }
    }

    void draw_wire(const LayoutWire& wire, bool chosen) {
        const ImVec4 colour = chosen         ? k_accent_colour
                              : wire.skipped ? ImVec4(0.4f, 0.4f, 0.42f, 0.35f)
                              : wire.back    ? ImVec4(0.62f, 0.52f, 0.36f, 0.6f)
                                             : ImVec4(0.5f, 0.56f, 0.64f, 0.75f);
        const float width = std::max((chosen ? 0.16f : 0.09f) * em_, 1.0f);
        const ImU32 packed = ImGui::GetColorU32(colour);
        for (size_t i = 1; i < wire.points.size(); ++i) {
            const glm::vec2 a = place(wire.points[i - 1]), b = place(wire.points[i]);
            if (wire.back || i % 2 == 0)
                list_.AddLine(screen(a), screen(b), packed, width);
            else {
                const float middle = 0.5f * (a.x + b.x);
                list_.AddBezierCubic(screen(a), {middle, a.y}, {middle, b.y}, screen(b), packed, width);
            }
        }
    }

    /// Text that ends at the edge of its box.
    void text(glm::vec2 at, float right, const std::string& words, const ImVec4& colour, float size = 1) {
        const float pixels = size * em_;
        if (pixels < 4) return; // nobody could read it
        const ImVec4 clip(at.x, at.y, right, at.y + 2 * pixels);
        list_.AddText(ImGui::GetFont(), pixels, screen(at), ImGui::GetColorU32(colour), words.data(),
                      words.data() + words.size(), 0, &clip);
    }

    void draw_tick(const LayoutBox& box, bool hovered) {
        const glm::vec2 min = tick_min(box);
        const float side = tick_side();
        const PassNode* node = graph_.model().find_node(box.id);
        list_.AddRectFilled(screen(min), screen(min + side),
                            ImGui::GetColorU32(hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg), 0.15f * em_);
        if (node && node->enabled)
            list_.AddRectFilled(screen(min + 0.2f * side), screen(min + 0.8f * side),
                                ImGui::GetColorU32(ImGuiCol_CheckMark), 0.1f * em_);
        note(("nodes.tick." + box.id), min, min + side);
    }

    void note(const std::string& name, glm::vec2 min, glm::vec2 max) const {
        const glm::vec2 middle = 0.5f * (min + max);
        if (glm::all(glm::greaterThanEqual(middle, min_)) && glm::all(glm::lessThan(middle, min_ + size_)))
            note_rectangle(name, min.x, min.y, max.x, max.y);
    }

    void draw_box(const LayoutBox& box, bool hovered, const Hit& hit) {
        const glm::vec2 min = place(box.min), max = place(box.min + box.size);
        const bool runs = box.plan >= 0;
        const std::string& pinned = context_.ui.pinned;
        const bool shown =
            !pinned.empty() && std::find(box.outputs.begin(), box.outputs.end(), pinned) != box.outputs.end();
        list_.AddRectFilled(screen(min), screen(max), runs ? IM_COL32(52, 54, 60, 255) : IM_COL32(34, 34, 36, 255),
                            0.3f * em_);
        const ImVec4 edge = shown ? k_pinned_colour : hovered ? k_accent_colour : ImVec4(0.3f, 0.3f, 0.33f, 1);
        list_.AddRect(screen(min), screen(max), ImGui::GetColorU32(edge), 0.3f * em_, 0, shown ? 2.0f : 1.0f);
        const bool stale = runs && graph_.pass_is_stale(box.id);
        const ImVec4 words = !runs ? k_dim_colour : stale ? k_error_colour : ImGui::GetStyleColorVec4(ImGuiCol_Text);
        const float right = max.x - 0.4f * em_;
        if (runs) draw_cost(box, min, max);
        draw_tick(box, hovered && hit.tick);
        text(min + glm::vec2(1.8f, 0.25f) * em_, right, box.id, words);
        text(min + glm::vec2(0.5f, 1.5f) * em_, right, runs ? cost_text(box) : box.skipped, k_dim_colour, 0.9f);
        note("nodes.pass." + box.id, min, {max.x, min.y + k_layout_head * em_});
        for (int i = 0; i < int(box.outputs.size()); ++i)
            draw_output(box, i, hovered && hit.output == i);
    }

    /// A bar to scale with the slowest pass.
    void draw_cost(const LayoutBox& box, glm::vec2 min, glm::vec2 max) {
        const PassTiming timing = graph_.timing(box.id);
        if (slowest_ <= 0 || !timing.samples || timing.unchanged) return;
        const float share = float(std::min(timing.median / slowest_, 1.0));
        list_.AddRectFilled({min.x + 1, min.y + 1.45f * em_},
                            {min.x + 1 + share * (max.x - min.x - 2), min.y + 2.6f * em_},
                            ImGui::GetColorU32(k_bar_colour));
    }

    std::string cost_text(const LayoutBox& box) const {
        const PassTiming timing = graph_.timing(box.id);
        const double mib = double(bytes_of_pass(graph_.plan(), box.id)) / (1 << 20);
        std::string ms = "- ms";
        if (timing.unchanged)
            ms = fmt::format("unchanged ({:.3f})", timing.last);
        else if (timing.samples || timing.last > 0)
            ms = fmt::format("{:.3f} ms{}", timing.samples ? timing.median : timing.last,
                             timing.samples ? "" : " (old)");
        return fmt::format("{}  {:.2f} MiB", ms, mib);
    }

    void draw_output(const LayoutBox& box, int row, bool hovered) {
        const std::string& name = box.outputs[size_t(row)];
        const glm::vec2 min = place({box.min.x, layout_row_y(box, row) - 0.5f * k_layout_row}),
                        max = place({box.min.x + box.size.x, layout_row_y(box, row) + 0.5f * k_layout_row});
        if (hovered) list_.AddRectFilled(screen(min), screen(max), ImGui::GetColorU32(ImGuiCol_HeaderHovered));
        const ImVec4 colour = name == context_.ui.pinned ? k_pinned_colour
                              : box.plan < 0             ? ImVec4(0.45f, 0.45f, 0.47f, 1)
                                                         : ImVec4(0.78f, 0.8f, 0.84f, 1);
        const float width = 0.9f * em_ / ImGui::GetFontSize() * ImGui::CalcTextSize(name.c_str()).x;
        text({std::max(max.x - width - 0.5f * em_, min.x + 0.3f * em_), min.y + 0.15f * em_}, max.x, name, colour,
             0.9f);
        list_.AddCircleFilled({max.x, 0.5f * (min.y + max.y)}, std::max(0.2f * em_, 1.5f), ImGui::GetColorU32(colour));
        note("nodes.resource." + box.id + "." + name, min, max);
    }

    void explain(const Hit& hit) {
        if (hit.box < 0) return;
        const LayoutBox& box = state_.layout.boxes[size_t(hit.box)];
        if (hit.tick) return tooltip("switch " + box.id + " on or off");
        if (hit.output >= 0) return explain_output(box, box.outputs[size_t(hit.output)]);
        if (box.plan < 0) return tooltip(box.id + " is skipped: " + box.skipped);
        const PlanPass& pass = graph_.plan().passes[size_t(box.plan)];
        const std::string output = main_output(graph_.plan(), pass);
        context_.ui.hovered = output;
        std::string words = pass_details(graph_.model(), graph_.plan(), pass) + "\n" + time_text(graph_.timing(box.id));
        for (const CounterValue& counter : graph_.counters())
            if (counter.pass == box.id) words += fmt::format("\n{} {}", counter.value, counter.label);
        if (!output.empty()) words += "\nClick to keep " + output + " in view";
        tooltip(words);
    }

    static void tooltip(const std::string& words) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 34);
        show_text(words);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }

    /// A texture with a thumbnail of it as it would be shown.
    void explain_output(const LayoutBox& box, const std::string& name) {
        const PlanResource* resource = graph_.plan().find_resource(name);
        if (!resource) return tooltip(fmt::format("{}: not made, since {} is skipped", name, box.id));
        ImGui::BeginTooltip();
        show_text(name + ": " + resource_text(*resource));
        const GpuTexture* texture = resource->is_buffer() ? nullptr : graph_.texture(name);
        if (const GpuTexture* small = texture ? picture_of(name, *texture) : nullptr) {
            const glm::vec2 texels(small->desc().size);
            const float side = k_thumbnail * ImGui::GetFontSize();
            const glm::vec2 shown = texels * (side / std::max(texels.x, texels.y));
            ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(small->id())), screen(shown));
            note_widget("nodes.thumbnail");
        }
        show_text(resource->is_buffer() ? "Click to see its words." : "Click to keep it in view.", k_dim_colour);
        ImGui::EndTooltip();
    }

    const GpuTexture* picture_of(const std::string& name, const GpuTexture& texture) {
        if (!state_.thumbnail) state_.thumbnail = std::make_unique<TextureView>();
        if (state_.pictured != name || state_.pictured_frame != graph_.frames()) {
            state_.thumbnail->draw(texture, default_view(name, texture.desc()), context_.session.value_scale(name));
            state_.pictured = name;
            state_.pictured_frame = graph_.frames();
        }
        return &state_.thumbnail->picture();
    }

    PanelContext& context_;
    NodesState& state_;
    const Graph& graph_;
    ImDrawList& list_;
    glm::vec2 min_, size_; ///< of the panel, on the screen
    float em_ = 1;         ///< pixels
    double slowest_ = 0;
};

} // namespace

void draw_nodes_panel(PanelContext& context) {
    const Graph& graph = context.session.graph();
    if (!graph.planned()) return;
    if (!context.ui.nodes) context.ui.nodes = std::make_shared<NodesState>();
    NodesState& state = *context.ui.nodes;
    if (state.model != &graph.model() || state.plans != graph.plans()) {
        state.layout = lay_out_graph(graph.model(), graph.plan(), context.session.facts(), state.skipped);
        state.whole = state.whole || state.model != &graph.model();
        state.model = &graph.model();
        state.plans = graph.plans();
    }
    if (ImGui::SmallButton("whole graph")) state.whole = true;
    note_widget("nodes.whole");
    ImGui::SameLine();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(1, 1));
    if (ImGui::Checkbox("skipped", &state.skipped)) state.plans = ~0ull, state.whole = true;
    ImGui::PopStyleVar();
    note_widget("nodes.skipped");
    show_tooltip("Passes that do not run are shown, too.");
    ImGui::SameLine();
    show_text(fmt::format("{} passes, {} skipped   wheel: zoom, drag: move, click: keep in view, tick: on or off",
                          graph.plan().passes.size(), graph.plan().skipped.size()),
              k_dim_colour);
    NodesView(context, state).draw();
}

} // namespace bounce
