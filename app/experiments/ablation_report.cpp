#include "app/experiments/ablation_report.h"

#include "app/experiments/csv.h"
#include "app/experiments/html_page.h"
#include "app/experiments/svg_scatter.h"
#include "core/base64.h"
#include "core/heat_map.h"
#include "core/printable.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

std::string percent(double share) {
    return fmt::format("{:+.1f} %", 100 * share);
}

std::string points(double error, double uncertainty) {
    return fmt::format("{:+.2f} ± {:.2f}", 100 * error, 100 * uncertainty);
}

std::string figures_text(const VariantFigures& figures) {
    return fmt::format("{:.3g} ms, {:.1f} MiB, bias {:+.2f} %, error {:.2f} %", figures.ms,
                       double(figures.bytes) / 1048576.0, 100 * figures.bias, 100 * figures.error);
}

std::string summary(const Ablation& ablation, const AblationSettings& settings) {
    std::string out =
        fmt::format("{} through {}: {}.", settings.session.shot, settings.session.graph, figures_text(ablation.whole));
    if (ablation.dropped.empty())
        return out + fmt::format(" All of it is worth its time at {} % of error for each % of time.", settings.worth);
    return out + fmt::format(" The minimal graph, without {}: {}.", join(ablation.dropped, "; "),
                             figures_text(ablation.minimal_figures));
}

/// A bar from the middle: to the right what is lost without the part.
std::string bar(double value, double largest) {
    constexpr double width = 160, height = 12;
    const double length = largest > 0 ? std::abs(value) / largest * width / 2 : 0;
    return fmt::format("<svg width=\"{0}\" height=\"{1}\"><rect x=\"{2:.1f}\" width=\"{3:.1f}\" height=\"{1}\" "
                       "fill=\"{4}\"/><line x1=\"{5}\" x2=\"{5}\" y2=\"{1}\" stroke=\"#888\"/></svg>",
                       width, height, value < 0 ? width / 2 - length : width / 2, length,
                       value < 0 ? "#0072b2" : "#d55e00", width / 2);
}

} // namespace

std::string ablation_markdown(const Ablation& ablation, const AblationSettings& settings, const Origin& origin) {
    std::string out =
        origin_head({origin}) + "\n" + markdown_cell(summary(ablation, settings)) +
        "\n\n| without | time | memory | error, points | flicker, points | bias |\n| --- | ---: | ---: | ---: | ---: "
        "| ---: |\n";
    std::string failures;
    for (const std::vector<AblatedPart>* list : {&ablation.parts, &ablation.pairs})
        for (const AblatedPart& part : *list) {
            if (!part.failed.empty()) {
                failures += fmt::format("- {}: {}\n", markdown_cell(part.name), markdown_cell(part.failed));
                continue;
            }
            out += fmt::format("| {} | {} | {} | {} | {:+.2f} | {} |\n", markdown_cell(part.name),
                               percent(part.time_change), percent(part.bytes_change),
                               points(part.error_change, part.uncertainty), 100 * part.flicker_change,
                               percent(part.figures.bias));
        }
    return failures.empty() ? out : out + "\nThe graph does not work without:\n\n" + failures;
}

std::string ablation_csv(const Ablation& ablation) {
    std::string out = "without,ms,bytes,error,error_spread,bias,flicker,time_change,bytes_change,error_change,flicker_"
                      "change,failed\n";
    const auto line = [&](const std::string& name, const VariantFigures& f, const AblatedPart& p) {
        out += fmt::format("{},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", csv_field(name),
                           f.ms, f.bytes, f.error, f.error_spread, f.bias, f.flicker, p.time_change, p.bytes_change,
                           p.error_change, p.flicker_change, csv_field(p.failed));
    };
    line("", ablation.whole, {});
    for (const std::vector<AblatedPart>* list : {&ablation.parts, &ablation.pairs})
        for (const AblatedPart& part : *list)
            line(part.name, part.figures, part);
    return out;
}

std::string ablation_html(const Ablation& ablation, const AblationSettings& settings, const Origin& origin,
                          const VariantMeasurer& measurer) {
    double most_error = 0, most_time = 0;
    for (const AblatedPart& part : ablation.parts) {
        most_error = std::max(most_error, std::abs(part.error_change));
        most_time = std::max(most_time, std::abs(part.time_change));
    }
    std::string body = "<h1>What each part buys</h1>\n<p class=\"origin\">" + escape_markup(origin_head({origin})) +
                       "</p>\n<p>" + escape_markup(summary(ablation, settings)) +
                       "</p>\n<p class=\"hint\">Maps: where the picture changes without the part, in shares of the "
                       "reference's mean, " +
                       heat_scale_markup(0.5) +
                       ".</p>\n<table class=\"sortable wide\"><tr><th>without</th><th colspan=\"2\">error, points</th>"
                       "<th colspan=\"2\">time</th><th>memory</th><th>flicker, points</th><th class=\"plain\">where"
                       "</th></tr>\n";
    const double mean = [&] {
        double sum = 0;
        for (float value : measurer.reference().pixels)
            sum += value;
        return sum / double(std::max<size_t>(measurer.reference().pixels.size(), 1));
    }();
    for (const std::vector<AblatedPart>* list : {&ablation.parts, &ablation.pairs})
        for (const AblatedPart& part : *list) {
            if (!part.failed.empty()) {
                body += fmt::format("<tr><td>{}</td><td colspan=\"7\">{}</td></tr>\n", escape_markup(part.name),
                                    escape_markup(part.failed));
                continue;
            }
            Image map(part.figures.picture.width, part.figures.picture.height, 1);
            const int channels = part.figures.picture.channels;
            for (size_t i = 0; i < map.pixels.size(); ++i) {
                for (int c = 0; c < channels; ++c)
                    map.pixels[i] += std::abs(part.figures.picture.pixels[i * size_t(channels) + size_t(c)] -
                                              ablation.whole.picture.pixels[i * size_t(channels) + size_t(c)]);
                map.pixels[i] = mean > 0 ? float(map.pixels[i] / (channels * mean)) : 0;
            }
            body += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:+.2f}</"
                                "td><td>{}</td></tr>\n",
                                escape_markup(part.name), points(part.error_change, part.uncertainty),
                                bar(part.error_change, most_error), percent(part.time_change),
                                bar(part.time_change, most_time), percent(part.bytes_change), 100 * part.flicker_change,
                                png_markup(base64(encode_png(heat_map(map, 0, 0.5f))), "where, 0 … 50 %"));
        }
    return html_page({"what each part buys", body + "</table>\n", "null", {}});
}

} // namespace bounce
