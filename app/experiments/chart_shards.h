#pragma once
// What a run of a chart was to measure, kept beside its points: by it a run that died is found when parts are joined.

#include "app/experiments/chart_point.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

struct ShardRecord {
    int shard = 0, shards = 1;
    std::string plan;                ///< digest of the tasks of all shards: those of one chart have the same
    std::vector<std::string> labels; ///< of its own tasks
    std::vector<std::string> names;  ///< the same tasks as PointTask::name says them
    bool ended = false;              ///< false: it runs still, or it died
    std::vector<std::string> failed; ///< "label: error" of tasks that could not be measured
    std::filesystem::path folder;    ///< where it was found; not kept in the file
};

/// Of this shard of the tasks, before anything is measured.
ShardRecord shard_record(const std::vector<PointTask>& tasks, int shard, int shards);

/// Written as folder/shards/3-of-16.json. Throws Error.
void write_shard_record(const ShardRecord& record, const std::filesystem::path& folder);

/// All that lie in a folder; none where there is no shards/ in it. Damaged files are an Error.
std::vector<ShardRecord> load_shard_records(const std::filesystem::path& folder);

/// A line for each shard that died, that left nothing, or that could not measure a point: which, what is missing, and
/// what measures it. `points`: what there is of all shards.
std::vector<std::string> dead_shards(const std::vector<ShardRecord>& records, const std::vector<ChartPoint>& points);

} // namespace bounce
