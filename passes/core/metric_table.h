#pragma once
// The metrics, one table entry each. Everything that tells how far a picture is from a reference follows from the
// table: `bounce compare` (text and JSON), charts (CSV, JSON, HTML, SVG, Markdown), sweeps and cost tables that name a
// metric, and the Compare panel.

#include "core/flip.h"
#include "core/metrics.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

/// A picture and its reference: of one size and channel count, finite. What metrics are computed from.
struct ComparedPair {
    const Image& test;
    const Image& reference;
    const Mask& mask;
    double test_noise = 0;      ///< RMS standard error in the pictures' units; 0: not known
    double reference_noise = 0; ///< likewise
    ErrorFigures figures;       ///< of the above
    /// Linear RGB in [0,1] as a viewer sees it, for metrics that need a display; null: not made.
    const Image* shown_test = nullptr;
    const Image* shown_reference = nullptr;
    float ppd = k_flip_pixels_per_degree;
};

enum class MetricUnit {
    number, ///< of a scale of its own
    count,
    image, ///< that of the pictures: radiance, or AO units (the share of the hemisphere that is open)
    share, ///< a ratio, printed in %
};

enum class MetricNeeds {
    values, ///< linear values: cheap
    shown,  ///< display values and neighbourhoods: slow
};

struct Metric {
    std::string name;  ///< snake_case: the key in JSON, the column in CSV, what --metric takes
    std::string title; ///< in headings; two metrics that say the same in different units share it
    MetricUnit unit = MetricUnit::number;
    MetricNeeds needs = MetricNeeds::values;
    double (*compute)(const ComparedPair&) = nullptr;
    std::string format = ".4f"; ///< of fmt, for the number as printed
    /// Occlusion is told absolutely: the metric that says the same in the pictures' own units; "": this one.
    std::string absolute = {};
    double ideal = 0;    ///< of a picture that equals its reference: charts draw the distance from it
    bool detail = false; ///< only in JSON and CSV, not in tables that a person reads
};

/// In the order in which they are shown. Whoever adds an entry (before anything is compared) finds it in every output.
std::vector<Metric>& metrics();
/// Those that a person reads.
std::vector<const Metric*> brief_metrics();
/// Throws Error naming the nearest.
const Metric& find_metric(const std::string& name);
/// `metric`, or what stands for it where only occlusion is compared.
const Metric& metric_for(const Metric& metric, bool occlusion);

/// The values of one comparison by metric, in the table's order. Metrics that were not computed are not there.
class MetricValues {
  public:
    void set(const std::string& name, double value);
    std::optional<double> find(const std::string& name) const;
    /// NaN when it is not there.
    double operator[](const std::string& name) const;
    bool empty() const { return values_.empty(); }
    auto begin() const { return values_.begin(); }
    auto end() const { return values_.end(); }

  private:
    std::vector<std::pair<std::string, double>> values_;
};

/// Every metric of the table for which the pair has what is needed.
MetricValues compute_metrics(const ComparedPair& pair);

/// "bias %", "SSIM".
std::string metric_heading(const Metric& metric);
/// The number alone, in % for shares; "–" for NaN, "inf" as such.
std::string metric_number(const Metric& metric, double value);
/// With its unit: "+1.25 %", "0.0312 AO". What `metric_for` chooses is shown.
std::string metric_text(const Metric& metric, const MetricValues& values, bool occlusion);

/// By name; infinite and NaN become null, which JSON has instead.
nlohmann::ordered_json metrics_json(const MetricValues& values);
/// The numbers of such an object; null becomes infinite. What is no number is left out.
MetricValues metrics_from_json(const nlohmann::ordered_json& json);

} // namespace bounce
