#pragma once
// One point of a chart: a shot through a graph with some parameters; what it cost and how far it is from the truth.

#include "app/experiments/method_figures.h"
#include "app/session.h"
#include "core/comparison.h"

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace bounce {

/// By which errors are drawn when nothing else is asked for.
inline constexpr const char* k_default_error = "relative_rmse";

struct PointTask {
    SessionOptions session; ///< as `bounce render` takes them; the size is always given
    int warm_up = 3, frames = 10;
    double reference_noise = 0.01;
    int reference_samples = 0;      ///< above 0: instead of the noise goal
    bool device_reference = false;  ///< by the graph path_traced
    std::vector<std::string> parts; ///< whose sum is compared; empty: what the graph's transport says
    std::optional<int> bounces;     ///< of the reference, instead of what the graph's transport says
    std::optional<bool> diffuse_only;
    bool thorough = false; ///< MethodFigures are measured too

    glm::ivec2 size() const { return session.size.value_or(glm::ivec2(0)); }
    /// Names the task (session, frames, reference goal): the same text for the same task.
    std::string name() const;
    /// The command that makes this point's picture.
    std::string command() const;
    /// What graph.rebuild is: "every_frame" unless the point sets it.
    std::string rebuild() const;
    /// Shot, graph, values and switches in a few words.
    std::string label() const;
};

/// Digests of what a point was measured with; see point_content.h.
struct PointContent {
    std::string commit, graph, shot;            ///< "": not told
    std::map<std::string, std::string> shaders; ///< expanded, of the passes that ran
};

struct PassCost {
    std::string id;
    double median_ms = 0, low_ms = 0, high_ms = 0;
    uint64_t bytes = 0;
};

struct ChartPoint {
    PointTask task;
    std::string key; ///< 16 hexadecimal digits: names the task and the content
    PointContent content;
    std::vector<PassCost> passes;
    std::vector<std::pair<std::string, std::string>> skipped; ///< pass, reason
    double total_ms = 0;
    uint64_t bytes = 0;
    int transport_bounces = -1;
    std::vector<std::string> parts;        ///< that were compared
    MetricValues same_transport, full;     ///< against the reference of the graph's own transport, and of all light
    double kept_share = 1;                 ///< of the pixels: off depth and normal edges
    std::string renderer, driver, machine; ///< see Origin
    std::string measured;                  ///< when: UTC, "2026-01-31T12:00:00Z"
    std::string thumbnail_png, error_png;  ///< base64
    std::optional<MethodFigures> figures;  ///< of a thorough task
    std::string reference_png;             ///< likewise: what the thumbnail should look like
    bool on_front = false;                 ///< filled in by mark_pareto

    /// Whether its errors are told in AO units: see only_occlusion.
    bool absolute() const;
    /// Against the same transport by this metric (in AO units where only occlusion is compared): the distance from what
    /// an equal picture has, as charts draw it.
    double error(const Metric& metric) const;
};

/// Fills in the errors of a frame that `session` has rendered (its frame index is the reference's), and the pictures.
void compare_with_reference(Session& session, ChartPoint& point, const std::function<void(const std::string&)>& say);

/// The key of a task's point that is measured with this content.
std::string point_key(const PointTask& task, const PointContent& content);

/// Renders and measures. Throws Error. `say` gets lines of progress.
ChartPoint measure_point(const PointTask& task, const PointContent& content,
                         const std::function<void(const std::string&)>& say);

std::string point_to_json(const ChartPoint& point);
/// Throws Error when the text is no point.
ChartPoint point_from_json(const std::string& text, const std::string& where);

/// Marks the points that no other of their shot and their transport beats in both time and error.
void mark_pareto(std::vector<ChartPoint>& points, const Metric& metric);

} // namespace bounce
