#include "app/graph_svg.h"

#include "app/experiments/svg_scatter.h"
#include "app/pass_rows.h"
#include "app/timings.h"
#include "core/text.h"

#include <fmt/format.h>

namespace bounce {

namespace {

constexpr float k_em = 13; // pixels

/// Straight within columns, curved between them.
std::string path_of(const LayoutWire& wire) {
    std::string path;
    for (size_t i = 0; i < wire.points.size(); ++i) {
        const glm::vec2 p = wire.points[i] * k_em;
        if (i == 0)
            path += fmt::format("M{:.1f} {:.1f}", p.x, p.y);
        else if (wire.back || i % 2 == 0)
            path += fmt::format("L{:.1f} {:.1f}", p.x, p.y);
        else {
            const glm::vec2 before = wire.points[i - 1] * k_em;
            const float middle = 0.5f * (before.x + p.x);
            path += fmt::format("C{0:.1f} {1:.1f} {0:.1f} {2:.1f} {3:.1f} {2:.1f}", middle, before.y, p.y, p.x);
        }
    }
    return path;
}

std::string text_at(float x, float y, const std::string& text, const char* style) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, style, escape_markup(text));
}

/// As many letters as fit.
std::string cut(const std::string& text, float width) {
    const auto letters = size_t(std::max(width / 0.55f, 1.0f));
    return text.size() <= letters ? text : text.substr(0, letters - 1) + "…";
}

std::string box_svg(const GraphModel& model, const Plan& plan, const LayoutBox& box) {
    const bool runs = box.plan >= 0;
    const glm::vec2 min = box.min * k_em, size = box.size * k_em;
    std::string title =
        runs ? pass_details(model, plan, plan.passes[size_t(box.plan)]) : box.id + " is skipped: " + box.skipped;
    std::string out =
        fmt::format("<g class=\"pass{}\"><title>{}</title>\n", runs ? "" : " skipped", escape_markup(title));
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"4\"/>\n", min.x, min.y,
                       size.x, size.y);
    const float left = min.x + 0.5f * k_em;
    std::string note = cut(box.skipped, box.size.x);
    if (runs) note = format_bytes(double(bytes_of_pass(plan, box.id)));
    if (runs && plan.passes[size_t(box.plan)].repeat_to - plan.passes[size_t(box.plan)].repeat_from != 1)
        note += fmt::format(", {} steps",
                            plan.passes[size_t(box.plan)].repeat_to - plan.passes[size_t(box.plan)].repeat_from);
    out += text_at(left, min.y + 1.15f * k_em, box.id, " font-weight=\"bold\"");
    out += text_at(left, min.y + 2.25f * k_em, note, " class=\"note\"");
    for (int i = 0; i < int(box.outputs.size()); ++i)
        out += text_at(min.x + size.x - 0.6f * k_em, layout_row_y(box, i) * k_em + 0.35f * k_em, box.outputs[size_t(i)],
                       " text-anchor=\"end\"");
    return out + "</g>\n";
}

} // namespace

std::string graph_svg(const GraphModel& model, const Plan& plan, const SceneFacts& facts) {
    const GraphLayout layout = lay_out_graph(model, plan, facts);
    const float head = 3, pad = 1;
    const glm::vec2 size = (layout.size + glm::vec2(2 * pad, head + pad)) * k_em;
    std::string out =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                    "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"{2}\">\n"
                    "<style>.pass rect{{fill:#fff3d6;stroke:#8a6d2f}}.skipped rect{{fill:#eee;stroke:#aaa;"
                    "stroke-dasharray:4 3}}.skipped text,.note{{fill:#777}}path{{fill:none;stroke:#4878a8;"
                    "stroke-width:1.3}}.back{{stroke-dasharray:2 3}}.idle{{stroke:#bbb;stroke-dasharray:4 3}}"
                    "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
                    size.x, size.y, k_em);
    out += text_at(k_em, 1.5f * k_em,
                   fmt::format("{} at {}×{}: {} passes, {} skipped, {}", model.file().name, plan.size.x, plan.size.y,
                               plan.passes.size(), plan.skipped.size(), format_bytes(double(plan.total_bytes()))),
                   " font-weight=\"bold\"");
    out += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n", pad * k_em, head * k_em);
    for (const LayoutWire& wire : layout.wires)
        out += fmt::format("<path class=\"wire{}{}\" d=\"{}\"><title>{}: {} → {}{}</title></path>\n",
                           wire.back ? " back" : "", wire.skipped ? " idle" : "", path_of(wire),
                           escape_markup(wire.resource), layout.boxes[size_t(wire.from)].id,
                           layout.boxes[size_t(wire.to)].id, wire.back ? ", from an earlier frame or step" : "");
    for (const LayoutBox& box : layout.boxes)
        out += box_svg(model, plan, box);
    return out + "</g>\n</svg>\n";
}

} // namespace bounce
