// Over time: the passes' times one on another, memory, error and change of the last frames. A click pins a frame.
#include "app/panels/panel.h"
#include "app/ui/live_comparison.h"
#include "app/ui/marks.h"
#include "app/ui/timeline.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace bounce {

namespace {

ImU32 colour_of(size_t pass, float alpha = 1) {
    // Hues a golden ratio apart differ from their neighbours.
    float r = 0, g = 0, b = 0;
    ImGui::ColorConvertHSVtoRGB(std::fmod(0.58f + 0.618034f * float(pass), 1.0f), 0.5f, 0.85f, r, g, b);
    return ImGui::GetColorU32({r, g, b, alpha});
}

/// The largest value, without lone outliers such as the compiling of a shader; something above 0.
float top_of(const Timeline& timeline, const std::function<float(const TimelineFrame&)>& value) {
    std::vector<float> all;
    for (const TimelineFrame& frame : timeline.frames)
        if (const float v = value(frame); v >= 0) all.push_back(v);
    if (all.empty()) return 0;
    std::sort(all.begin(), all.end());
    const float high = all[all.size() * 95 / 100];
    return std::max({1.15f * high, 1e-9f, all.back() < 3 * high ? 1.15f * all.back() : 0.0f});
}

class Plots {
  public:
    Plots(Timeline& timeline, ImVec2 size) : timeline_(timeline), at_(ImGui::GetCursorScreenPos()), size_(size) {
        step_ = std::max(std::floor(size.x / float(Timeline::k_kept)), std::floor(0.3f * ImGui::GetFontSize()));
    }

    void draw(const std::string& error_name) {
        ImGui::InvisibleButton("plots", size_);
        note_widget("time.plots");
        const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
        const float height = (size_.y - 9) / 4;
        stacked(at_.y, 2 * height);
        line(at_.y + 2 * height + 3, 0.8f * height, "memory, MiB", "{:.1f}", IM_COL32(140, 190, 240, 255),
             [](const TimelineFrame& f) { return float(double(f.bytes) / (1 << 20)); });
        line(at_.y + 2.8f * height + 6, 0.6f * height, error_name, "{:.4g}", IM_COL32(240, 150, 110, 255),
             [](const TimelineFrame& f) { return f.error; });
        line(at_.y + 3.4f * height + 9, 0.6f * height, "change, % of white", "{:.3f}", IM_COL32(190, 220, 120, 255),
             [](const TimelineFrame& f) { return f.change < 0 ? -1 : 100 * f.change; });
        if (hovered || clicked) {
            const TimelineFrame* frame = frame_at(ImGui::GetIO().MousePos.x);
            if (frame && clicked) timeline_.pinned = timeline_.pinned == frame->number ? 0 : frame->number;
            if (frame) mark(*frame, IM_COL32(255, 255, 255, 120));
        }
        for (const TimelineFrame& frame : timeline_.frames)
            if (frame.number == timeline_.pinned) mark(frame, ImGui::GetColorU32(k_pinned_colour));
    }

  private:
    float right_of(size_t index) const { return at_.x + size_.x - step_ * float(timeline_.frames.size() - 1 - index); }
    bool visible(size_t index) const { return right_of(index) - step_ >= at_.x; }

    const TimelineFrame* frame_at(float x) const {
        for (size_t i = 0; i < timeline_.frames.size(); ++i)
            if (visible(i) && x >= right_of(i) - step_ && x < right_of(i)) return &timeline_.frames[i];
        return nullptr;
    }

    void mark(const TimelineFrame& frame, ImU32 colour) const {
        const float x = right_of(size_t(frame.number - timeline_.frames.front().number)) - 0.5f * step_;
        ImGui::GetWindowDrawList()->AddLine({x, at_.y}, {x, at_.y + size_.y}, colour);
    }

    void ground(float y, float height, const std::string& title, float top, const char* format) const {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled({at_.x, y}, {at_.x + size_.x, y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
        const std::string text =
            title + (top > 0 ? "   top " + fmt::format(fmt::runtime(format), top) : std::string(": not measured"));
        list.AddText({at_.x + 4, y + 1}, ImGui::GetColorU32(k_dim_colour), text.c_str());
    }

    void stacked(float y, float height) const {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float top = top_of(timeline_, [](const TimelineFrame& f) { return f.passes_ms(); });
        ground(y, height, "passes, GPU ms", top, "{:.3g}");
        if (top <= 0) return;
        for (size_t i = 0; i < timeline_.frames.size(); ++i) {
            if (!visible(i)) continue;
            const TimelineFrame& frame = timeline_.frames[i];
            float base = y + height;
            for (size_t pass = 0; pass < frame.passes.size(); ++pass) {
                const float next = std::max(base - height * frame.passes[pass] / top, y);
                if (base - next > 0.2f)
                    list.AddRectFilled({right_of(i) - step_, next}, {right_of(i), base}, colour_of(pass, 0.9f));
                base = next;
            }
            if (frame.settings_changed)
                list.AddLine({right_of(i) - step_, y}, {right_of(i) - step_, y + height}, IM_COL32(255, 255, 255, 50));
        }
    }

    void line(float y, float height, const std::string& title, const char* format, ImU32 colour,
              const std::function<float(const TimelineFrame&)>& value) const {
        const float top = top_of(timeline_, value);
        ground(y, height, title, top, format);
        if (top <= 0) return;
        ImVec2 last{0, 0};
        bool joined = false;
        for (size_t i = 0; i < timeline_.frames.size(); ++i) {
            const float v = value(timeline_.frames[i]);
            const bool there = v >= 0 && visible(i);
            const ImVec2 at{right_of(i) - 0.5f * step_, y + height * (1 - std::clamp(v / top, 0.0f, 1.0f))};
            if (there && joined) ImGui::GetWindowDrawList()->AddLine(last, at, colour, 1.5f);
            if (there && !joined) ImGui::GetWindowDrawList()->AddCircleFilled(at, 1.5f, colour);
            last = at, joined = there;
        }
    }

    Timeline& timeline_;
    ImVec2 at_, size_;
    float step_;
};

/// The chosen frame's passes, slowest first, beside the median of all frames that are kept.
void draw_figures(const Timeline& timeline, const TimelineFrame& frame) {
    const bool pinned = frame.number == timeline.pinned;
    show_text(fmt::format("{} {} (shot frame {})", pinned ? "pinned: frame" : "newest: frame", frame.number,
                          frame.shot_frame),
              pinned ? k_pinned_colour : k_dim_colour);
    note_widget(pinned ? "time.pinned" : "time.newest");
    show_text(fmt::format("frame {:.2f} ms, passes {:.2f} ms, {:.1f} MiB", frame.ms, frame.passes_ms(),
                          double(frame.bytes) / (1 << 20)));
    if (frame.error >= 0) show_text(fmt::format("error {:.4g}", frame.error));
    if (frame.change >= 0) show_text(fmt::format("change {:.3f} %", 100 * frame.change));
    if (frame.settings_changed) show_text("settings changed before it", k_warning_colour);
    std::vector<size_t> order;
    for (size_t pass = 0; pass < frame.passes.size(); ++pass)
        if (frame.passes[pass] > 0) order.push_back(pass);
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return frame.passes[a] > frame.passes[b]; });
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("pass", 0, 5);
    ImGui::TableSetupColumn("ms", 0, 2);
    ImGui::TableSetupColumn("median", 0, 2);
    ImGui::TableHeadersRow();
    for (size_t pass : order) {
        std::vector<float> all;
        for (const TimelineFrame& other : timeline.frames)
            if (pass < other.passes.size() && other.passes[pass] > 0) all.push_back(other.passes[pass]);
        std::nth_element(all.begin(), all.begin() + long(all.size() / 2), all.end());
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        show_text("■", ImGui::ColorConvertU32ToFloat4(colour_of(pass)));
        ImGui::SameLine(0, 3);
        show_text(timeline.passes[pass]);
        ImGui::TableNextColumn();
        show_right(fmt::format("{:.3f}", frame.passes[pass]));
        ImGui::TableNextColumn();
        show_right(fmt::format("{:.3f}", all[all.size() / 2]));
    }
    ImGui::EndTable();
}

} // namespace

void draw_time_panel(PanelContext& context) {
    if (!context.ui.timeline) return show_text("no frame yet", k_dim_colour);
    Timeline& timeline = *context.ui.timeline;
    timeline.wants_change = true;
    const TimelineFrame* frame = timeline.shown();
    if (!frame) return show_text("no frame yet", k_dim_colour);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float figures = std::min(ImGui::GetFontSize() * 20, 0.4f * room.x);
    std::string error = "error (of the Compare panel)";
    if (context.ui.comparison && context.ui.comparison->measured()) error = "error: " + context.ui.comparison->metric;
    ImGui::BeginChild("plots", {room.x - figures - 8, 0});
    Plots(timeline, {std::max(room.x - figures - 8, 10.0f), std::max(room.y, 40.0f)}).draw(error);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("figures");
    draw_figures(timeline, *frame);
    ImGui::EndChild();
}

} // namespace bounce
