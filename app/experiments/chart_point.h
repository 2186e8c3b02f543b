#pragma once
// One point of a chart: a shot through a graph with some parameters; what it cost and how far it is from the truth.

#include "app/experiments/sweep.h"
#include "core/image.h"
#include "graph/graph_file.h"
#include "reference/reference_image.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

struct PointTask {
    std::string shot, graph;
    ParameterValues values;
    glm::ivec2 size{0};
    int warm_up = 3, frames = 10;
    double reference_noise = 0.01;
    int reference_samples = 0; ///< above 0: instead of the noise goal
    int device = -1;
    std::vector<std::string> parts; ///< whose sum is compared; empty: what the graph's transport says

    /// Names the task (shot, graph, values, size, frames, reference goal): the same text for the same task.
    std::string key() const;
    /// The command that makes this point's picture.
    std::string command() const;
    /// Shot, graph and values in a few words.
    std::string label() const;
};

/// Error of a point against one reference.
struct PointError {
    double mean = 0, reference_mean = 0; ///< of the picture and of the reference, in their own units
    double rmse_without_noise = 0;       ///< rmse, less what the reference's own noise explains, in the same units
    double bias = 0, rmse = 0, relative_rmse = 0, relative_mse = 0, p99 = 0, flip = 0, ssim = 0;
    double reference_noise = 0; ///< relative, of the reference itself
};

struct PassCost {
    std::string id;
    double median_ms = 0, low_ms = 0, high_ms = 0;
    uint64_t bytes = 0;
};

struct ChartPoint {
    PointTask task;
    std::string key;
    std::vector<PassCost> passes;
    std::vector<std::pair<std::string, std::string>> declined; ///< pass, reason
    double total_ms = 0;
    uint64_t bytes = 0;
    int transport_bounces = -1;
    std::vector<std::string> parts; ///< that were compared
    PointError same_transport, full;
    double kept_share = 1; ///< of the pixels: off depth and normal edges
    std::string renderer, commit;
    std::string thumbnail_png, error_png; ///< base64
    bool on_front = false;                ///< filled in by mark_pareto

    /// Whether its errors are told in AO units: see only_occlusion.
    bool absolute() const;
    /// Against the same transport: RMSE in AO units, or else relative to the reference's mean.
    double shown_error() const;
};

class Session;
/// Fills in the errors of a frame that `session` has rendered (its frame index is the reference's), and the pictures.
void compare_with_reference(Session& session, ChartPoint& point, const std::function<void(const std::string&)>& say);

/// Renders and measures. Throws Error. `say` gets lines of progress.
ChartPoint measure_point(const PointTask& task, const std::function<void(const std::string&)>& say);

std::string point_to_json(const ChartPoint& point);
/// Throws Error when the text is no point.
ChartPoint point_from_json(const std::string& text, const std::string& where);

/// Marks, per shot, the points that no other beats in both time and error against the same transport.
void mark_pareto(std::vector<ChartPoint>& points);

} // namespace bounce
