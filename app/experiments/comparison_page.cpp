#include "app/experiments/comparison_page.h"

#include "app/experiments/html_page.h"
#include "app/experiments/page_picture.h"
#include "app/experiments/svg_scatter.h"
#include "app/origin.h"
#include "core/heat_map.h"

#include <fmt/format.h>

namespace bounce {

namespace {

std::string row(const std::string& name, const MetricValues& values) {
    std::string out = "<tr><td>" + escape_markup(name) + "</td>";
    for (const Metric* metric : brief_metrics()) {
        const auto value = values.find(metric->name);
        out += "<td>" + (value ? metric_number(*metric, *value) : "") + "</td>";
    }
    return out + "</tr>\n";
}

/// The metrics in AO units, on a line below the part's own.
std::string occlusion_row(const MetricValues& values) {
    std::string out = "<tr><td>in AO units</td>";
    for (const Metric* metric : brief_metrics()) {
        const Metric& absolute = metric_for(*metric, true);
        out += "<td>" + (&absolute == metric ? "" : metric_number(absolute, values[absolute.name])) + "</td>";
    }
    return out + "</tr>\n";
}

std::string shown_name(const std::string& part) {
    return part.empty() ? "(picture)" : part;
}

std::string figure(const std::string& png, const std::string& caption) {
    return "<figure>" + png_markup(png, caption) + "<figcaption>" + escape_markup(caption) + "</figcaption></figure>\n";
}

} // namespace

std::string comparison_html(const ComparisonReport& report, const ComparedPictures& p) {
    const Mask& mask = report.comparison.mask;
    std::string body = "<h1>Two pictures</h1>\n<p class=\"origin\">" + escape_markup(origin_head({origin_here()})) +
                       "</p>\n<p>" +
                       escape_markup(fmt::format("{} against the reference {}: {}", report.image, report.reference,
                                                 shown_name(p.part))) +
                       ". The map shows the error in shares of the reference's mean, " + heat_scale_markup(p.top) +
                       "; grey pixels do not count.</p>\n<div class=\"compared pictures\">\n";
    for (const auto& [image, name] : {std::pair(&p.image, &report.image), std::pair(&p.reference, &report.reference)})
        body += figure(page_picture(*image, p.light, p.exposure, k_compared_width), *name);
    body += figure(page_error_map(relative_error_map(p.image, p.reference), p.top, mask, k_compared_width),
                   fmt::format("relative error, 0 … {:g} %", 100 * p.top));
    body += "</div>\n<h2>Figures by part</h2>\n";
    for (const std::string& note : comparison_notes(report))
        body += "<p class=\"hint\">" + escape_markup(note) + "</p>\n";
    body += "<table class=\"sortable\"><tr><th>part</th>";
    for (const Metric* metric : brief_metrics())
        body += "<th>" + escape_markup(metric_heading(*metric)) + "</th>";
    body += "</tr>\n";
    for (const PartComparison& part : report.comparison.parts) {
        const bool occlusion = part.part.find("ambient_occlusion") != std::string::npos;
        body += row(shown_name(part.part), part.figures);
        if (occlusion) body += occlusion_row(part.figures);
        if (part.windowed.empty()) continue;
        body += row(fmt::format("{0}, means over {1} × {1}", shown_name(part.part), report.window), part.windowed);
        if (occlusion) body += occlusion_row(part.windowed);
    }
    for (const SurfaceComparison& surface : report.surfaces)
        body += row(fmt::format("{}, material {} facing {}", shown_name(surface.part), surface.material, surface.axis),
                    surface.figures);
    return html_page({"two pictures", body + "</table>\n", "null", {"pictures"}});
}

} // namespace bounce
