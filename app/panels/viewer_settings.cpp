#include "app/panels/viewer_settings.h"

#include "app/ui/marks.h"
#include "app/ui/texture_view.h"
#include "app/ui/viewed.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

/// A label at the left, then what follows takes the rest of the line.
static void label(const char* text) {
    ImGui::AlignTextToFramePadding();
    show_text(text, k_dim_colour);
    ImGui::SameLine(ImGui::GetFontSize() * 4.2f);
    ImGui::SetNextItemWidth(-FLT_MIN);
}

static bool draw_range(ViewerSettings& viewer) {
    bool changed = false;
    label("range");
    changed |= ImGui::Checkbox("automatic", &viewer.automatic_range);
    note_widget("viewer.automatic_range");
    show_tooltip("From the least to the greatest finite value of what is shown, found again in each picture.");
    ImGui::SameLine();
    changed |= ImGui::Checkbox("logarithmic", &viewer.logarithmic);
    note_widget("viewer.logarithmic");
    show_tooltip("Equal ratios are equal steps of brightness. From zero: six decades below the upper end.");
    ImGui::SameLine();
    changed |= ImGui::Checkbox("colours", &viewer.false_colour);
    note_widget("viewer.false_colour");
    show_tooltip("False colour: one number per texel, from black over blue, red and yellow to white.");
    if (viewer.automatic_range) return changed;
    label("");
    float range[2] = {viewer.low, viewer.high};
    float speed = std::max({std::abs(viewer.high - viewer.low), std::abs(viewer.high) * 1e-3f, 1e-4f}) * 0.005f;
    if (ImGui::DragFloat2("##range", range, speed, 0, 0, "%.5g")) {
        viewer.low = range[0], viewer.high = range[1];
        changed = true;
    }
    note_widget("viewer.range");
    show_tooltip("The values that are black and white. Either may be the greater one. Ctrl + click to type.");
    return changed;
}

/// Of the values in the viewport over the range that they are shown with; heights are square roots of counts.
static void draw_histogram(const PlanResource& resource) {
    viewed().wants_histogram = true;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 1.0f), ImGui::GetFontSize() * 4);
    ImGui::InvisibleButton("histogram", size);
    note_widget("viewer.histogram");
    const Viewed& found = viewed();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    if (found.resource != resource.name() || found.histogram.empty()) return;
    const auto count = float(found.histogram.size());
    uint32_t most = 1;
    for (uint32_t value : found.histogram)
        most = std::max(most, value);
    for (size_t i = 0; i < found.histogram.size(); ++i) {
        const float height = size.y * std::sqrt(float(found.histogram[i]) / float(most));
        list.AddRectFilled({at.x + size.x * float(i) / count, at.y + size.y - height},
                           {at.x + size.x * float(i + 1) / count, at.y + size.y},
                           ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    }
    show_tooltip(
        fmt::format("{:.5g} … {:.5g}: values in equal steps; heights are square roots of their number\n{} below, "
                    "{} above",
                    found.range.x, found.range.y, found.below, found.above));
}

void draw_viewer_settings(PanelContext& context, const PlanResource& resource) {
    ViewerSettings& viewer = context.ui.viewer;
    viewer = clamp_view(viewer, resource.texture);
    bool changed = false;
    if (resource.texture.mips > 1) {
        label("mip");
        glm::ivec3 size = mip_size(resource.texture, viewer.mip);
        std::string format = fmt::format("%d  ({}×{})", size.x, size.y);
        changed |= ImGui::SliderInt("##mip", &viewer.mip, 0, resource.texture.mips - 1, format.c_str());
        note_widget("viewer.mip");
    }
    int layers = mip_size(resource.texture, viewer.mip).z;
    if (layers > 1) {
        label(resource.texture.kind == TextureKind::texture_3d ? "slice" : "layer");
        std::string format = fmt::format("%d  of {}", layers);
        changed |= ImGui::SliderInt("##layer", &viewer.layer, 0, layers - 1, format.c_str());
        note_widget("viewer.layer");
    }
    int channels = format_by_enum(resource.texture.format).channels;
    if (channels > 1) {
        static constexpr const char* k_names[] = {"RGB", "R", "G", "B", "A", "|RGB|"};
        static constexpr const char* k_help[] = {"as a colour", "red",   "green",
                                                 "blue",        "alpha", "length of the vector"};
        label("channel");
        for (int c = 0; c < 6; ++c) {
            if ((c < 5 && c > channels) || (c == 5 && channels < 3)) continue;
            if (c) ImGui::SameLine(0, 4);
            changed |= ImGui::RadioButton(k_names[c], &viewer.channel, c);
            note_widget(fmt::format("viewer.channel.{}", c));
            show_tooltip(k_help[c]);
        }
    }
    changed |= draw_range(viewer);
    label("show");
    changed |= ImGui::Checkbox("sRGB curve", &viewer.encode_srgb);
    note_widget("viewer.encode_srgb");
    show_tooltip("Linear light is encoded for the display. Off: the value itself is what is shown.");
    ImGui::SameLine();
    changed |= ImGui::Checkbox("NaN, inf", &viewer.mark_non_finite);
    note_widget("viewer.mark_non_finite");
    show_tooltip("NaN is magenta, infinities are yellow.");
    ImGui::SameLine();
    if (ImGui::SmallButton("reset")) {
        viewer = default_view(resource.name(), resource.texture);
        changed = true;
    }
    note_widget("viewer.reset");
    if (context.ui.pinned == resource.name()) draw_histogram(resource);
    if (changed) context.ui.redraw();
}

std::string word_text(uint32_t word, int words) {
    switch (words) {
    case 0:
        return fmt::format("{:.6g}", std::bit_cast<float>(word));
    case 1:
        return fmt::format("{}", word);
    case 2:
        return fmt::format("{}", int32_t(word));
    default:
        return fmt::format("{:08x}", word);
    }
}

void draw_buffer_table(PanelContext& context, const PlanResource& resource) {
    static constexpr uint64_t k_rows = 32;
    BufferSettings& settings = context.ui.buffer;
    const Buffer* buffer = context.session.graph().buffer(resource.name());
    if (!buffer) return;
    uint64_t stride = uint64_t(std::max(resource.declaration.stride, 4));
    uint64_t columns = stride <= 32 ? stride / 4 : 4; // longer elements take several rows of four words
    if (resource.declaration.stride == 4) columns = 4;
    uint64_t row_bytes = columns * 4, words_in_all = buffer->bytes() / 4;
    uint64_t pages = std::max<uint64_t>(1, (words_in_all + columns * k_rows - 1) / (columns * k_rows));
    settings.page = std::clamp(settings.page, 0, int(std::min<uint64_t>(pages, INT32_MAX) - 1));

    label("words");
    static constexpr const char* k_words[] = {"float", "uint", "int", "hex"};
    for (int i = 0; i < 4; ++i) {
        if (i) ImGui::SameLine(0, 6);
        ImGui::RadioButton(k_words[i], &settings.words, i);
        note_widget(fmt::format("buffer.words.{}", i));
    }
    label("page");
    if (ImGui::InputInt("##page", &settings.page)) settings.page = std::clamp(settings.page, 0, int(pages) - 1);
    note_widget("buffer.page");
    show_tooltip(fmt::format("{} pages of {} bytes", pages, row_bytes * k_rows));

    uint64_t first = uint64_t(settings.page) * k_rows * columns;
    std::vector<uint32_t> words(std::min(k_rows * columns, words_in_all - std::min(first, words_in_all)));
    buffer->read(first * 4, words.size() * 4, words.data());
    if (words.empty()) show_text("empty", k_dim_colour);
    ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY;
    ImVec2 size(0, std::max(ImGui::GetContentRegionAvail().y, ImGui::GetTextLineHeightWithSpacing() * 8));
    if (words.empty() || !ImGui::BeginTable("words", int(columns) + 1, flags, size)) return;
    ImGui::PushFont(fixed_font());
    for (size_t at = 0; at < words.size(); at += columns) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        uint64_t byte = (first + at) * 4;
        show_text(byte % stride == 0 ? fmt::format("[{}]", byte / stride) : fmt::format("+{}", byte % stride),
                  k_dim_colour);
        for (size_t c = at; c < std::min(at + columns, words.size()); ++c) {
            ImGui::TableNextColumn();
            show_right(word_text(words[c], settings.words));
        }
    }
    ImGui::PopFont();
    ImGui::EndTable();
}

} // namespace bounce
