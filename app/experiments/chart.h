#pragma once
// Runs a chart's tasks: resumable, in shards, merged.

#include "app/experiments/chart_point.h"

#include <filesystem>
#include <functional>

namespace bounce {

struct ChartPlan {
    std::vector<PointTask> tasks; ///< in a fixed order
    std::filesystem::path folder;
    std::string against;       ///< draw errors over this parameter: see svg_scatter
    int shard = 0, shards = 1; ///< this run does the tasks with index mod shards = shard
};

/// Measures what is not there yet (each point is a file in folder/points), then writes the report over every point of
/// the tasks that exists. A point that fails is reported and left out; the Error thrown at the end names all of them.
void run_chart(const ChartPlan& plan, const std::function<void(const std::string&)>& say);

/// Copies the points of other folders into `folder` and writes the report over all of them. Throws Error.
void merge_charts(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& folder,
                  const std::string& against = "");

/// The points of a folder, sorted by shot, graph and values. Damaged files are an Error.
std::vector<ChartPoint> load_points(const std::filesystem::path& folder);

} // namespace bounce
