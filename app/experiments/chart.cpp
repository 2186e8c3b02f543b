#include "app/experiments/chart.h"

#include "app/experiments/chart_shards.h"
#include "app/experiments/point_content.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>

namespace bounce {

namespace fs = std::filesystem;

static fs::path point_path(const fs::path& folder, const std::string& key) {
    return folder / "points" / (key + ".json");
}

static void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error(fmt::format("cannot create the folder '{}': {}", folder.string(), error.message()));
}

static void sort_points(std::vector<ChartPoint>& points) {
    std::sort(points.begin(), points.end(), [](const ChartPoint& a, const ChartPoint& b) {
        const SessionOptions &s = a.task.session, &t = b.task.session;
        return std::tie(s.shot, s.graph, s.sets, s.switches, a.key) <
               std::tie(t.shot, t.graph, t.sets, t.switches, b.key);
    });
}

std::vector<ChartPoint> load_points(const fs::path& folder) {
    std::vector<ChartPoint> points;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder / "points", ignored)) {
        if (entry.path().extension() == ".json")
            points.push_back(point_from_json(read_file(entry.path(), k_max_json_text), entry.path().string()));
    }
    sort_points(points);
    return points;
}

/// The point of the same task that was measured with what is nearest to this content, the newest of several; null when
/// there is none. It tells why a point has to be measured again.
static const ChartPoint* nearest_point(const std::vector<ChartPoint>& points, const PointTask& task,
                                       const PointContent& content) {
    const ChartPoint* nearest = nullptr;
    for (const ChartPoint& point : points) {
        if (point.task.name() != task.name()) continue;
        const auto order = [&](const ChartPoint& p) { return -int(content_differences(p.content, content).size()); };
        if (!nearest || std::pair(order(*nearest), nearest->measured) < std::pair(order(point), point.measured))
            nearest = &point;
    }
    return nearest;
}

void run_chart(const ChartPlan& plan, const std::function<void(const std::string&)>& say) {
    make_folder(plan.folder / "points");
    const std::vector<ChartPoint> found = load_points(plan.folder);
    ShardRecord record = shard_record(plan.tasks, plan.shard, plan.shards);
    write_shard_record(record, plan.folder);
    ErrorList errors;
    ContentReader contents;
    std::set<std::string> wanted;
    size_t done = 0;
    const size_t all = plan.tasks.size(), n = size_t(plan.shards), first = size_t(plan.shard);
    const size_t mine = all > first ? (all - first + n - 1) / n : 0;
    for (size_t i = 0; i < all; ++i) {
        const PointTask& task = plan.tasks[i];
        const bool own = i % n == first;
        if (own) ++done;
        auto tell = [&](const std::string& text) { say(fmt::format("{}/{} {}: {}", done, mine, task.label(), text)); };
        try {
            const PointContent content = contents.content_of(task);
            const std::string key = point_key(task, content);
            wanted.insert(key);
            if (!own) continue;
            const fs::path path = point_path(plan.folder, key);
            if (std::error_code ignored; fs::exists(path, ignored) && plan.resume) {
                tell("there already");
                continue;
            }
            if (const ChartPoint* old = plan.resume ? nearest_point(found, task, content) : nullptr)
                tell("measured again; changed since: " + join(content_differences(old->content, content), ", "));
            const ChartPoint point = measure_point(task, content, say);
            write_file_atomically(path, point_to_json(point));
            tell(fmt::format("{:.3g} ms, {}", point.total_ms, error_summary(point.same_transport, point.absolute())));
        } catch (const Error& error) {
            if (!own) continue; // whoever measures it tells
            record.failed.push_back(task.label() + ": " + error.what());
            errors.add(record.failed.back());
            tell(error.what());
        }
    }
    record.ended = true;
    write_shard_record(record, plan.folder);
    std::vector<ChartPoint> points = load_points(plan.folder);
    std::erase_if(points, [&](const ChartPoint& point) { return !wanted.contains(point.key); });
    if (!points.empty()) write_report(points, plan.folder, plan.view);
    if (!points.empty() && plan.also_write) plan.also_write(points);
    errors.throw_if_any("chart");
}

void merge_charts(const std::vector<fs::path>& folders, const fs::path& folder, const ChartView& view,
                  const std::function<void(const std::string&)>& say, const AlsoWrite& also_write) {
    std::vector<ChartPoint> points;
    std::vector<ShardRecord> shards;
    for (const fs::path& from : folders) {
        if (std::error_code ignored; !fs::is_directory(from / "points", ignored))
            throw Error(fmt::format("'{}' is no chart's folder: there is no points/ in it", from.string()));
        for (ChartPoint& point : load_points(from))
            points.push_back(std::move(point));
        for (ShardRecord& record : load_shard_records(from))
            shards.push_back(std::move(record));
    }
    make_folder(folder / "points");
    for (ChartPoint& point : load_points(folder))
        points.push_back(std::move(point));
    std::vector<std::string> left_out;
    points = points_of_one_program(std::move(points), left_out);
    for (const std::string& line : left_out)
        say(line);
    if (points.empty()) throw Error("there are no points to merge");
    for (const ChartPoint& point : points)
        write_file_atomically(point_path(folder, point.key), point_to_json(point));
    sort_points(points);
    write_report(points, folder, view);
    if (also_write) also_write(points);
    ErrorList missing;
    for (const std::string& line : dead_shards(shards, points))
        missing.add(line);
    missing.throw_if_any("chart --merge");
}

} // namespace bounce
