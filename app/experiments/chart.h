#pragma once
// Runs a chart's tasks: resumable, in shards, merged.

#include "app/experiments/report.h"

#include <filesystem>
#include <functional>

namespace bounce {

/// Writes more about the points of a chart, after its own report.
using AlsoWrite = std::function<void(const std::vector<ChartPoint>&)>;

struct ChartPlan {
    std::vector<PointTask> tasks; ///< in a fixed order
    std::filesystem::path folder;
    ChartView view;
    AlsoWrite also_write;
    bool resume = true; ///< keep points that this program has measured already, of the same graph, shaders and shot
    int shard = 0, shards = 1; ///< this run does the tasks with index mod shards = shard
};

/// Measures what is not there yet (each point is a file in folder/points), then writes the report over every point of
/// the tasks that exists and was measured with the same content; of one that was measured with another, `say` is told
/// why it is measured again. A point that fails is reported and left out; the Error thrown at the end names all of
/// them.
void run_chart(const ChartPlan& plan, const std::function<void(const std::string&)>& say);

/// Copies the points of other folders into `folder` and writes the report over all of them that one program measured;
/// `say` is told which are left out, and why. Throws Error, at the end also for shards that died: it names each, and
/// what measures the rest.
void merge_charts(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& folder,
                  const ChartView& view, const std::function<void(const std::string&)>& say,
                  const AlsoWrite& also_write = {});

/// The points of a folder, sorted by shot, graph and values. Damaged files are an Error.
std::vector<ChartPoint> load_points(const std::filesystem::path& folder);

} // namespace bounce
