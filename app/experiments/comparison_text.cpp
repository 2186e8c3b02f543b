#include "app/experiments/comparison_text.h"

#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bounce {

namespace {

constexpr size_t k_name_width = 28, k_least_width = 9;

size_t width_of(const Metric& metric) {
    return std::max(k_least_width, metric_heading(metric).size());
}

/// A name and a column for each metric; empty where the values do not hold it.
std::string row(const std::string& name, const MetricValues& values) {
    std::string text = fmt::format("{:{}}", name, k_name_width);
    for (const Metric* metric : brief_metrics()) {
        const auto value = values.find(metric->name);
        text += fmt::format(" {:>{}}", value ? metric_number(*metric, *value) : "", width_of(*metric));
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

std::string occlusion_line(const MetricValues& values) {
    std::vector<std::string> told;
    for (const Metric* metric : brief_metrics()) {
        const Metric& absolute = metric_for(*metric, true);
        if (&absolute != metric) told.push_back(absolute.title + " " + metric_number(absolute, values[absolute.name]));
    }
    return "  in AO units: " + join(told, ", ") + "\n";
}

} // namespace

std::vector<std::string> comparison_notes(const ComparisonReport& report) {
    std::vector<std::string> notes = {fmt::format(
        "{:.1f} % of the pixels count{}. RMSE and noise are relative to the reference's mean.",
        100 * report.comparison.mask.share(), report.comparison.edges_masked ? ", away from edges" : "; no edge mask")};
    if (report.pixels_a_side > 1)
        notes.push_back(fmt::format(
            "The image is {0} times as wide and high as the reference: compared are means over {0} x {0} pixels.",
            report.pixels_a_side));
    for (const auto& [name, outside] :
         {std::pair(report.image, report.outside), std::pair(report.reference, report.reference_outside)}) {
        if (outside > 0)
            notes.push_back(fmt::format("{:.1f} % of '{}' lies outside of its data window and counts as black.",
                                        100 * outside, name));
    }
    return notes;
}

std::string comparison_text(const ComparisonReport& report) {
    std::string text = fmt::format("{:{}}", "part", k_name_width);
    for (const Metric* metric : brief_metrics())
        text += fmt::format(" {:>{}}", metric_heading(*metric), width_of(*metric));
    text += "\n";
    for (const PartComparison& part : report.comparison.parts) {
        text += row(part.part.empty() ? "(picture)" : part.part, part.figures);
        const bool occlusion = part.part.find("ambient_occlusion") != std::string::npos;
        if (occlusion) text += occlusion_line(part.figures);
        if (part.windowed.empty()) continue;
        text += row(fmt::format("  means over {0} x {0}", report.window), part.windowed);
        if (occlusion) text += occlusion_line(part.windowed);
    }
    for (const SurfaceComparison& surface : report.surfaces)
        text += row(fmt::format("  material {} facing {}", surface.material, surface.axis), surface.figures);
    for (const std::string& note : comparison_notes(report))
        text += note + "\n";
    return text;
}

std::string comparison_json(const ComparisonReport& report) {
    nlohmann::ordered_json json;
    json["image"] = report.image;
    json["reference"] = report.reference;
    json["means_over_pixels"] = report.pixels_a_side * report.pixels_a_side;
    json["outside_data_window"] = report.outside;
    json["reference_outside_data_window"] = report.reference_outside;
    json["edges_masked"] = report.comparison.edges_masked;
    json["kept_pixels"] = report.comparison.mask.share();
    for (const PartComparison& part : report.comparison.parts) {
        nlohmann::ordered_json entry = metrics_json(part.figures);
        entry["exposure"] = part.exposure;
        if (!part.windowed.empty()) {
            entry["windowed"] = {{"window", report.window}};
            entry["windowed"].update(metrics_json(part.windowed));
        }
        json["parts"][part.part] = entry;
    }
    for (const SurfaceComparison& surface : report.surfaces) {
        nlohmann::ordered_json entry = {{"part", surface.part}, {"material", surface.material}, {"axis", surface.axis}};
        entry.update(metrics_json(surface.figures));
        json["surfaces"].push_back(entry);
    }
    return json.dump(2);
}

} // namespace bounce
