#pragma once
// Tables of memory and time in the form of a paper's: passes and resources grouped into its stages and structures,
// shots and settings as its columns, and its own figures beside ours.
//   { "about": "…", "graph": "lrsm",
//     "columns": [{"name": "Sponza", "shot": "sponza", "size": [1280, 720], "set": {"occlusion_voxels.resolution":
//     512}}], "memory":  [{"name": "Occlusion voxels", "resources": ["voxels.occlusion"], "published": {"Sponza":
//     156.4}}], "time":    [{"name": "Voxelization", "passes": ["occlusion_voxels"], "published": {"Sponza": 5.3}}],
//                "passes": ["*"] is the whole frame
//     "counts":  [{"name": "Lists in all, MB", "counters": ["fragments of all maps"], "times": 8e-6, "published":
//     {…}}], "errors":  {"samples": 256, "metrics": ["bias"]},   against the reference of each column's transport, if
//     wanted "published_by": "LRSM paper, GTX 770" }

#include "app/experiments/sweep.h"
#include "core/metric_table.h"

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

struct CostTableColumn {
    std::string name, shot, graph;
    std::optional<glm::ivec2> size; ///< instead of the shot's
    ParameterValues sets;
};

struct CostTableRow {
    std::string name;
    std::vector<std::string> parts;          ///< resources or passes; their sum is the row
    bool counted = true;                     ///< in the last row's sum; a row of passes that other rows hold is not
    double times = 1;                        ///< counts: the factor to the row's unit
    std::map<std::string, double> published; ///< by column: MB (10⁶ bytes) or ms, as the paper prints them
};

struct CostTableFile {
    std::string about, published_by;
    std::vector<CostTableColumn> columns;
    std::vector<CostTableRow> memory, time;
    std::vector<CostTableRow> counts; ///< what passes counted, by label
    int error_samples = 0;            ///< of the reference that errors are against; 0: no errors
    std::vector<std::string> error_metrics = {"bias", "relative_rmse_denoised"}; ///< a row each
};

/// Throws Error that lists every problem. Finds "name" in assets/tables too.
CostTableFile load_cost_table(const std::string& name);

/// What one column measured: 10⁶ bytes and milliseconds by row; none where no part of the row ran.
struct CostTableMeasured {
    std::vector<std::optional<double>> memory_mb, time_ms, counts;
    std::vector<std::optional<double>> gb_per_s; ///< of the rows of time, if each pass moves each of its resources once
    double thread_ms = 0; ///< processor time of the thread that draws, a frame: Bounce and the driver's share in it
    MetricValues errors;
    bool absolute = false;             ///< only occlusion is compared: errors are told in AO units
    double total_mb = 0, total_ms = 0; ///< of the rows
};

/// Renders `warm_up` + `frames` frames; times are medians, or means over the frames where the column sets
/// graph.rebuild=on_change. Throws Error.
CostTableMeasured measure_column(const CostTableFile& file, const CostTableColumn& column,
                                 std::optional<glm::ivec2> size, int warm_up, int frames);

/// The tables as Markdown: ours, and the paper's figures in brackets.
std::string cost_table_markdown(const CostTableFile& file, const std::vector<CostTableMeasured>& measured);

} // namespace bounce
