#include "core/metric_table.h"

#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace bounce {

namespace {

using Pair = const ComparedPair&;
constexpr MetricUnit k_number = MetricUnit::number, k_count = MetricUnit::count, k_image = MetricUnit::image,
                     k_share = MetricUnit::share;
constexpr MetricNeeds k_values = MetricNeeds::values, k_shown = MetricNeeds::shown;
constexpr bool k_detail = true;

std::vector<Metric> built_in() {
    // What each is, is said with ErrorFigures and with the functions that are called here.
    return {
        {"pixels", "pixels", k_count, k_values, [](Pair p) { return double(p.figures.pixels); }, ".0f", "", 0,
         k_detail},
        {"mean", "mean", k_image, k_values, [](Pair p) { return p.figures.mean; }, ".5g"},
        {"reference_mean", "reference", k_image, k_values, [](Pair p) { return p.figures.reference_mean; }, ".5g"},
        {"bias", "bias", k_share, k_values, [](Pair p) { return p.figures.bias; }, "+.2f", "mean_difference"},
        {"mean_difference", "bias", k_image, k_values, [](Pair p) { return p.figures.mean_difference(); }, "+.4f", "",
         0, k_detail},
        {"rmse", "RMSE", k_image, k_values, [](Pair p) { return p.figures.rmse; }, ".4f", "", 0, k_detail},
        {"rmse_denoised", "RMSE w/o noise", k_image, k_values, [](Pair p) { return p.figures.rmse_denoised(); }, ".4f",
         "", 0, k_detail},
        {"relative_rmse", "RMSE", k_share, k_values, [](Pair p) { return p.figures.relative_rmse; }, ".2f", "rmse"},
        {"relative_rmse_denoised", "RMSE w/o noise", k_share, k_values,
         [](Pair p) { return p.figures.relative_rmse_denoised; }, ".2f", "rmse_denoised"},
        {"reference_noise", "noise", k_share, k_values, [](Pair p) { return p.figures.reference_noise; }, ".2f"},
        {"relative_mse", "relMSE", k_number, k_values, [](Pair p) { return p.figures.relative_mse; }},
        {"smape", "SMAPE", k_number, k_values, [](Pair p) { return p.figures.smape; }},
        {"relative_error_p99", "p99", k_share, k_values, [](Pair p) { return p.figures.relative_error_p99; }, ".2f"},
        {"largest_error", "largest", k_image, k_values, [](Pair p) { return p.figures.largest_error; }, ".4g", "", 0,
         k_detail},
        {"own_noise", "own noise", k_share, k_values,
         [](Pair p) { return p.figures.reference_mean != 0 ? p.test_noise / std::abs(p.figures.reference_mean) : 0; },
         ".2f", "", 0, k_detail},
        {"ssim", "SSIM", k_number, k_shown, [](Pair p) { return ssim(*p.shown_test, *p.shown_reference, p.mask); },
         ".4f", "", 1},
        {"flip", "FLIP", k_number, k_shown,
         [](Pair p) { return flip_mean(flip(*p.shown_test, *p.shown_reference, p.ppd), p.mask); }},
    };
}

} // namespace

std::vector<Metric>& metrics() {
    static std::vector<Metric> table = built_in();
    return table;
}

std::vector<const Metric*> brief_metrics() {
    std::vector<const Metric*> brief;
    for (const Metric& metric : metrics()) {
        if (!metric.detail) brief.push_back(&metric);
    }
    return brief;
}

const Metric& find_metric(const std::string& name) {
    std::vector<std::string> names;
    for (const Metric& metric : metrics()) {
        if (metric.name == name) return metric;
        names.push_back(metric.name);
    }
    throw Error("there is no metric '" + name + "'" + did_you_mean(name, names));
}

const Metric& metric_for(const Metric& metric, bool occlusion) {
    return occlusion && !metric.absolute.empty() ? find_metric(metric.absolute) : metric;
}

void MetricValues::set(const std::string& name, double value) {
    auto known = std::find_if(values_.begin(), values_.end(), [&](const auto& entry) { return entry.first == name; });
    if (known != values_.end())
        known->second = value;
    else
        values_.emplace_back(name, value);
}

std::optional<double> MetricValues::find(const std::string& name) const {
    for (const auto& [known, value] : values_) {
        if (known == name) return value;
    }
    return std::nullopt;
}

double MetricValues::operator[](const std::string& name) const {
    return find(name).value_or(std::numeric_limits<double>::quiet_NaN());
}

MetricValues compute_metrics(const ComparedPair& pair) {
    MetricValues values;
    for (const Metric& metric : metrics()) {
        const bool possible = metric.needs != MetricNeeds::shown || (pair.shown_test && pair.shown_reference);
        if (possible) values.set(metric.name, metric.compute(pair));
    }
    return values;
}

std::string metric_heading(const Metric& metric) {
    return metric.unit == MetricUnit::share ? metric.title + " %" : metric.title;
}

std::string metric_number(const Metric& metric, double value) {
    if (std::isnan(value)) return "–";
    if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
    return fmt::format(fmt::runtime("{:" + metric.format + "}"),
                       metric.unit == MetricUnit::share ? 100 * value : value);
}

std::string metric_text(const Metric& metric, const MetricValues& values, bool occlusion) {
    const Metric& shown = metric_for(metric, occlusion);
    const std::string number = metric_number(shown, values[shown.name]);
    if (shown.unit == MetricUnit::share) return number + " %";
    return shown.unit == MetricUnit::image && occlusion ? number + " AO" : number;
}

nlohmann::ordered_json metrics_json(const MetricValues& values) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [name, value] : values)
        json[name] = std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    return json;
}

MetricValues metrics_from_json(const nlohmann::ordered_json& json) {
    MetricValues values;
    for (const auto& [name, value] : json.items()) {
        if (value.is_number()) values.set(name, value.get<double>());
        if (value.is_null()) values.set(name, std::numeric_limits<double>::infinity());
    }
    return values;
}

} // namespace bounce
