#include "app/experiments/cost_table.h"

#include "app/broken_shaders.h"
#include "app/experiments/chart_point.h"
#include "app/experiments/table_file.h"
#include "app/session.h"
#include "app/timings.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/text.h"
#include "graph/shader_log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <glad/gl.h>
#include <nlohmann/json.hpp>
#include <set>

namespace bounce {

using nlohmann::ordered_json;

namespace {

std::vector<CostTableRow> rows_of(const ordered_json& json, const char* table, const char* parts, ErrorList& errors) {
    std::vector<CostTableRow> rows;
    if (!json.contains(table)) return rows;
    if (!json[table].is_array()) {
        errors.add(fmt::format("'{}' must be a list of rows", table));
        return rows;
    }
    for (const ordered_json& entry : json[table]) {
        std::string where = fmt::format("{}[{}]", table, rows.size());
        CostTableRow row;
        if (!entry.is_object() || !entry.contains(parts) || !entry[parts].is_array()) {
            errors.add(fmt::format("{}: a row is {{\"name\": …, \"{}\": […]}}", where, parts));
            continue;
        }
        check_keys(entry, where, {"name", parts, "times", "published", "counted"}, errors);
        row.counted = entry.value("counted", true);
        row.name = text_at(entry, "name", where, errors, true);
        if (entry.contains("times") && entry["times"].is_number())
            row.times = entry["times"].get<double>();
        else if (entry.contains("times"))
            errors.add(where + ": 'times' must be a number");
        for (const ordered_json& part : entry[parts])
            row.parts.push_back(set_text(part));
        if (entry.contains("published") && entry["published"].is_object()) {
            for (const auto& [column, value] : entry["published"].items()) {
                if (value.is_number())
                    row.published[column] = value.get<double>();
                else
                    errors.add(fmt::format("{}: the published figure of '{}' must be a number", where, column));
            }
        }
        rows.push_back(row);
    }
    return rows;
}

std::optional<glm::ivec2> size_at(const ordered_json& entry, const std::string& where, ErrorList& errors) {
    if (!entry.contains("size")) return std::nullopt;
    const ordered_json& size = entry["size"];
    auto is_side = [](const ordered_json& side) {
        return side.is_number_integer() && side.get<int64_t>() >= 1 && side.get<int64_t>() <= 16384;
    };
    if (size.is_array() && size.size() == 2 && is_side(size[0]) && is_side(size[1]))
        return glm::ivec2(size[0].get<int>(), size[1].get<int>());
    errors.add(where + ", size: expected [width, height], each from 1 to 16384");
    return std::nullopt;
}

/// Processor time of the thread that draws, seconds.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Bytes of all that a pass reads and writes, each once.
double bytes_touched(const Plan& plan, const PlanPass& pass) {
    std::set<int> resources;
    for (const PlanSlot& slot : pass.slots)
        if (slot.resource >= 0) resources.insert(slot.resource);
    double bytes = 0;
    for (int resource : resources)
        bytes += double(plan.resources[size_t(resource)].total_bytes());
    return bytes;
}

bool rebuilds_on_change(const CostTableColumn& column) {
    return std::any_of(column.sets.begin(), column.sets.end(),
                       [](auto& set) { return set.first == "graph.rebuild" && set.second == "on_change"; });
}

} // namespace

CostTableFile load_cost_table(const std::string& name) {
    const std::filesystem::path path = find_table(name);
    const ordered_json json = read_table(path);
    if (!json.contains("columns") || !json["columns"].is_array())
        throw Error(path.string() +
                    ": a table is an object {\"graph\": …, \"columns\": […], \"memory\": […], \"time\": […]}");
    ErrorList errors;
    CostTableFile file;
    check_keys(json, "the table", {"about", "graph", "columns", "memory", "time", "counts", "errors", "published_by"},
               errors);
    file.about = text_at(json, "about", "the table", errors, false);
    file.published_by = text_at(json, "published_by", "the table", errors, false);
    std::string graph = text_at(json, "graph", "the table", errors, false);
    for (const ordered_json& entry : json["columns"]) {
        std::string where = fmt::format("columns[{}]", file.columns.size());
        CostTableColumn column;
        if (!entry.is_object()) {
            errors.add(where + ": a column is {\"name\": …, \"shot\": …, \"set\": {…}}");
            continue;
        }
        check_keys(entry, where, {"name", "shot", "graph", "size", "set"}, errors);
        column.name = text_at(entry, "name", where, errors, true);
        column.shot = text_at(entry, "shot", where, errors, true);
        column.graph = entry.contains("graph") ? text_at(entry, "graph", where, errors, true) : graph;
        if (column.graph.empty()) errors.add(where + ": neither the column nor the table names a graph");
        column.size = size_at(entry, where, errors);
        column.sets = sets_at(entry, where, errors);
        file.columns.push_back(column);
    }
    file.memory = rows_of(json, "memory", "resources", errors);
    file.time = rows_of(json, "time", "passes", errors);
    file.counts = rows_of(json, "counts", "counters", errors);
    if (json.contains("errors")) {
        const ordered_json& wanted = json["errors"];
        if (wanted.is_object() && wanted.contains("metrics")) file.error_metrics = metrics_at(wanted, "errors", errors);
        if (wanted.is_object() && wanted.contains("samples") && wanted["samples"].is_number_integer() &&
            wanted["samples"].get<int>() > 0)
            file.error_samples = wanted["samples"].get<int>();
        else
            errors.add("'errors' is {\"samples\": of the reference per pixel, \"metrics\": [names]}");
    }
    errors.throw_if_any(path.string());
    return file;
}

CostTableMeasured measure_column(const CostTableFile& file, const CostTableColumn& column,
                                 std::optional<glm::ivec2> size, int warm_up, int frames) {
    SessionOptions options;
    options.shot = column.shot;
    options.graph = column.graph;
    options.sets = column.sets;
    options.size = size ? size : column.size;
    set_shader_errors_logged(false);
    Session session(options);
    throw_if_broken(session, "nothing was measured");
    double started = 0;
    for (int frame = 0; frame < warm_up + frames; ++frame) {
        if (frame > 0) session.advance();
        if (frame == warm_up) {
            session.graph().forget_timings();
            started = thread_seconds();
        }
        session.render(true);
    }
    const double thread_ms = 1e3 * (thread_seconds() - started) / frames;
    session.graph().finish_timings();
    throw_if_broken(session, "nothing was measured");

    CostTableMeasured measured;
    measured.thread_ms = thread_ms;
    const Plan& plan = session.graph().plan();
    for (const CostTableRow& row : file.memory) {
        std::optional<double> sum;
        for (const std::string& name : row.parts) {
            if (const PlanResource* resource = plan.find_resource(name))
                sum = sum.value_or(0) + double(resource->total_bytes()) / 1e6;
        }
        measured.memory_mb.push_back(sum);
        measured.total_mb += sum.value_or(0);
    }
    for (const CostTableRow& row : file.time) {
        std::optional<double> sum;
        double bytes = 0;
        bool on_change = session.graph().model().rebuild() == Rebuild::on_change;
        for (const PlanPass& pass : plan.passes) {
            bool asked = std::any_of(row.parts.begin(), row.parts.end(),
                                     [&](const std::string& id) { return id == "*" || id == pass.id; });
            PassTiming timing = session.graph().timing(pass.id);
            if (!asked) continue;
            sum = sum.value_or(0) + (on_change ? timing.per_frame : timing.median);
            bytes += bytes_touched(plan, pass);
        }
        measured.time_ms.push_back(sum);
        measured.gb_per_s.push_back(sum && *sum > 0 ? std::optional(1e-6 * bytes / *sum) : std::nullopt);
        if (row.counted) measured.total_ms += sum.value_or(0);
    }
    for (const CostTableRow& row : file.counts) {
        std::optional<double> sum;
        for (const CounterValue& counter : session.graph().counters()) {
            if (std::find(row.parts.begin(), row.parts.end(), counter.label) != row.parts.end())
                sum = sum.value_or(0) + double(counter.value) * row.times;
        }
        measured.counts.push_back(sum);
    }
    if (file.error_samples > 0) {
        ChartPoint point;
        point.task.session = options;
        point.task.session.size = session.size();
        point.task.warm_up = warm_up;
        point.task.frames = frames;
        point.task.reference_samples = file.error_samples;
        point.parts = session.graph().model().file().transport.parts;
        compare_with_reference(session, point, [](const std::string&) {});
        measured.absolute = point.absolute();
        measured.errors = point.same_transport;
    }
    return measured;
}

std::string cost_table_markdown(const CostTableFile& file, const std::vector<CostTableMeasured>& measured) {
    std::string out;
    auto table = [&](const std::vector<CostTableRow>& rows, const char* unit, auto values, auto total,
                     bool with_total = true, bool with_published = true) {
        if (rows.empty()) return;
        out += fmt::format("| {} |", unit);
        std::string rule = "| --- |";
        for (size_t c = 0; c < measured.size(); ++c) {
            out += " " + markdown_cell(file.columns[c].name) + " |";
            rule += " ---: |";
        }
        out += "\n" + rule + "\n";
        std::vector<double> published_total(measured.size(), 0);
        for (size_t r = 0; r < rows.size(); ++r) {
            out += "| " + markdown_cell(rows[r].name) + " |";
            for (size_t c = 0; c < measured.size(); ++c) {
                std::optional<double> value = values(measured[c])[r];
                out += value ? fmt::format(" {:.1f}", *value) : " not run";
                auto published = rows[r].published.find(file.columns[c].name);
                if (with_published && published != rows[r].published.end()) {
                    out += fmt::format(" [{:.1f}]", published->second);
                    if (rows[r].counted) published_total[c] += published->second;
                }
                out += " |";
            }
            out += "\n";
        }
        if (!with_total) {
            out += "\n";
            return;
        }
        out += "| all |";
        for (size_t c = 0; c < measured.size(); ++c) {
            out += fmt::format(" {:.1f}", total(measured[c]));
            if (published_total[c] > 0) out += fmt::format(" [{:.1f}]", published_total[c]);
            out += " |";
        }
        out += "\n\n";
    };
    table(
        file.memory, "MB (10⁶ bytes)", [](auto& m) { return m.memory_mb; }, [](auto& m) { return m.total_mb; });
    table(
        file.time, "ms", [](auto& m) { return m.time_ms; }, [](auto& m) { return m.total_ms; });
    if (!file.time.empty()) {
        table(
            file.time, "GB/s", [](auto& m) { return m.gb_per_s; }, [](auto&) { return 0.0; }, false, false);
        out += "| a frame |";
        std::string rule = "\n| --- |", values = "\n| Processor ms of the thread that draws |";
        for (size_t c = 0; c < measured.size(); ++c) {
            out += " " + markdown_cell(file.columns[c].name) + " |";
            rule += " ---: |";
            values += fmt::format(" {:.2f} |", measured[c].thread_ms);
        }
        out += rule + values + "\n\n";
    }
    table(
        file.counts, "counted", [](auto& m) { return m.counts; }, [](auto&) { return 0.0; }, false);
    if (file.error_samples > 0) {
        out += "| error |";
        for (size_t c = 0; c < measured.size(); ++c)
            out += " " + markdown_cell(file.columns[c].name) + " |";
        out += "\n| --- |";
        for (size_t c = 0; c < measured.size(); ++c)
            out += " ---: |";
        for (const std::string& name : file.error_metrics) {
            const Metric& metric = find_metric(name);
            out += "\n| " + metric.title + " |";
            for (const CostTableMeasured& m : measured)
                out += " " + metric_text(metric, m.errors, m.absolute) + " |";
        }
        out += "\n\n";
    }
    if (!file.time.empty()) {
        std::vector<std::string> columns;
        for (const CostTableColumn& column : file.columns)
            if (rebuilds_on_change(column)) columns.push_back(column.name);
        out += columns.empty() ? "Every pass runs in every frame (graph.rebuild=every_frame).\n"
                               : "Every pass runs in every frame (graph.rebuild=every_frame), but with "
                                 "graph.rebuild=on_change, as means over the frames, in: " +
                                     join(columns, "; ") + ".\n";
    }
    if (!file.time.empty())
        out += "GB/s: as if each pass moved all of each of its textures and buffers once (10⁹ bytes).\n";
    if (std::getenv("BOUNCE_CPU_TIME")) out += "Times are processor time of all threads together.\n";
    if (!file.published_by.empty()) out += "In brackets: " + file.published_by + ".\n";
    return out;
}

} // namespace bounce
