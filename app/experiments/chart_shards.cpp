#include "app/experiments/chart_shards.h"

#include "core/error.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/text.h"
#include "reference/content_key.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace bounce {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ShardRecord shard_record(const std::vector<PointTask>& tasks, int shard, int shards) {
    ShardRecord record;
    record.shard = shard;
    record.shards = shards;
    ContentHash hash;
    for (size_t i = 0; i < tasks.size(); ++i) {
        hash.add(tasks[i].name() + "\n");
        if (i % size_t(shards) != size_t(shard)) continue;
        record.labels.push_back(tasks[i].label());
        record.names.push_back(tasks[i].name());
    }
    record.plan = hash.text();
    return record;
}

void write_shard_record(const ShardRecord& record, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder / "shards", error);
    if (error)
        throw Error(fmt::format("cannot create the folder '{}': {}", (folder / "shards").string(), error.message()));
    ordered_json json;
    json["shard"] = record.shard;
    json["shards"] = record.shards;
    json["plan"] = record.plan;
    json["ended"] = record.ended;
    json["failed"] = record.failed;
    json["points"] = record.labels;
    json["tasks"] = record.names;
    write_file_atomically(folder / "shards" / fmt::format("{}-of-{}.json", record.shard, record.shards),
                          json_dump(json, 1) + "\n");
}

static ShardRecord read_shard_record(const fs::path& path) {
    try {
        const auto json = parse_json<ordered_json>(read_file(path, k_max_json_text), path.string());
        ShardRecord record;
        record.shard = json.at("shard");
        record.shards = json.at("shards");
        record.plan = json.at("plan");
        record.ended = json.at("ended");
        record.failed = json.at("failed").get<std::vector<std::string>>();
        record.labels = json.at("points").get<std::vector<std::string>>();
        record.names = json.at("tasks").get<std::vector<std::string>>();
        record.folder = path.parent_path().parent_path();
        if (record.shard < 0 || record.shard >= record.shards || record.labels.size() != record.names.size())
            throw Error(path.string() +
                        ": not a shard of a chart: expected shard 0 … shards − 1, and as many points as tasks");
        return record;
    } catch (const ordered_json::exception& error) {
        throw Error(path.string() + ": not a shard of a chart: " + json_problem(error));
    }
}

std::vector<ShardRecord> load_shard_records(const fs::path& folder) {
    std::vector<ShardRecord> records;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder / "shards", ignored))
        if (entry.path().extension() == ".json") records.push_back(read_shard_record(entry.path()));
    std::sort(records.begin(), records.end(), [](auto& a, auto& b) { return a.shard < b.shard; });
    return records;
}

namespace {

/// The shards of one chart that was cut into so many.
using Cut = std::map<int, const ShardRecord*>;

std::vector<std::string> lines_of(const Cut& cut, int shards, const std::set<std::string>& there) {
    std::vector<std::string> lines;
    for (int i = 0; i < shards; ++i) {
        const auto found = cut.find(i);
        if (found == cut.end()) {
            lines.push_back(
                fmt::format("shard {0}/{1} left nothing: measure it (--shard {0}/{1}), or name its folder", i, shards));
            continue;
        }
        const ShardRecord& record = *found->second;
        std::vector<std::string> missing;
        for (size_t j = 0; j < record.names.size(); ++j)
            if (!there.contains(record.names[j])) missing.push_back(record.labels[j]);
        if (!record.ended && !missing.empty())
            lines.push_back(fmt::format("shard {}/{} did not end: {} of its {} points are missing, the first is '{}'; "
                                        "the same command goes on (--shard {}/{} -o {})",
                                        i, shards, missing.size(), record.names.size(), missing.front(), i, shards,
                                        record.folder.string()));
        for (const std::string& failed : record.failed)
            lines.push_back(fmt::format("shard {}/{} could not measure {}", i, shards, failed));
    }
    return lines;
}

} // namespace

std::vector<std::string> dead_shards(const std::vector<ShardRecord>& records, const std::vector<ChartPoint>& points) {
    std::set<std::string> there;
    for (const ChartPoint& point : points)
        there.insert(point.task.name());
    std::map<std::string, std::map<int, Cut>> charts; // by plan, by number of shards
    for (const ShardRecord& record : records) {
        const ShardRecord*& known = charts[record.plan][record.shards][record.shard];
        if (!known || record.ended) known = &record; // a run that ended makes up for one that died
    }
    std::vector<std::string> lines;
    for (const auto& [plan, cuts] : charts) {
        std::vector<std::string> own;
        bool complete = false;
        for (const auto& [shards, cut] : cuts) {
            const std::vector<std::string> of_cut = lines_of(cut, shards, there);
            complete = complete || of_cut.empty();
            own.insert(own.end(), of_cut.begin(), of_cut.end());
        }
        if (!complete) lines.insert(lines.end(), own.begin(), own.end());
    }
    return lines;
}

} // namespace bounce
