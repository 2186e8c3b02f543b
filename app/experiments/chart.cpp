#include "app/experiments/chart.h"

#include "app/experiments/report.h"
#include "core/error.h"

#include <algorithm>
#include <fmt/format.h>
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

std::vector<ChartPoint> load_points(const fs::path& folder) {
    std::vector<ChartPoint> points;
    if (!fs::is_directory(folder / "points")) return points;
    for (const auto& entry : fs::directory_iterator(folder / "points")) {
        if (entry.path().extension() == ".json")
            points.push_back(point_from_json(read_file(entry.path()), entry.path().string()));
    }
    std::sort(points.begin(), points.end(), [](const ChartPoint& a, const ChartPoint& b) {
        return std::tie(a.task.shot, a.task.graph, a.task.values) < std::tie(b.task.shot, b.task.graph, b.task.values);
    });
    return points;
}

void run_chart(const ChartPlan& plan, const std::function<void(const std::string&)>& say) {
    make_folder(plan.folder / "points");
    ErrorList errors;
    std::vector<const PointTask*> mine;
    for (size_t i = 0; i < plan.tasks.size(); ++i) {
        if (int(i % size_t(plan.shards)) == plan.shard) mine.push_back(&plan.tasks[i]);
    }
    size_t done = 0;
    for (const PointTask* task : mine) {
        ++done;
        fs::path path = point_path(plan.folder, task->key());
        if (fs::exists(path)) {
            say(fmt::format("{}/{} {}: there already", done, mine.size(), task->label()));
            continue;
        }
        try {
            ChartPoint point = measure_point(*task, say);
            write_file_atomically(path, point_to_json(point));
            const PointError& e = point.same_transport;
            const std::string told =
                point.absolute()
                    ? fmt::format("RMSE {:.4f} ({:.4f} without the reference's noise), bias {:+.4f} in AO units",
                                  e.rmse, e.rmse_without_noise, e.mean - e.reference_mean)
                    : fmt::format("relative RMSE {:.2f} %, bias {:+.2f} %", 100 * e.relative_rmse, 100 * e.bias);
            say(fmt::format("{}/{} {}: {:.3g} ms, {}", done, mine.size(), task->label(), point.total_ms, told));
        } catch (const Error& error) {
            errors.add(task->label() + ": " + error.what());
            say(fmt::format("{}/{} {}: {}", done, mine.size(), task->label(), error.what()));
        }
    }
    std::set<std::string> wanted;
    for (const PointTask& task : plan.tasks)
        wanted.insert(task.key());
    std::vector<ChartPoint> points = load_points(plan.folder);
    std::erase_if(points, [&](const ChartPoint& point) { return !wanted.contains(point.key); });
    if (!points.empty()) write_report(points, plan.folder, plan.against);
    errors.throw_if_any("chart");
}

void merge_charts(const std::vector<fs::path>& folders, const fs::path& folder, const std::string& against) {
    for (const fs::path& from : folders) {
        if (!fs::is_directory(from / "points"))
            throw Error(fmt::format("'{}' is no chart's folder: there is no points/ in it", from.string()));
    }
    make_folder(folder / "points");
    for (const fs::path& from : folders) {
        for (const ChartPoint& point : load_points(from))
            write_file_atomically(point_path(folder, point.key), point_to_json(point));
    }
    std::vector<ChartPoint> points = load_points(folder);
    if (points.empty()) throw Error("there are no points to merge");
    write_report(points, folder, against);
}

} // namespace bounce
