#include "app/experiments/error_table.h"

#include "app/broken_shaders.h"
#include "app/capture.h"
#include "app/experiments/table_file.h"
#include "app/experiments/transport.h"
#include "core/comparison.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/text.h"
#include "graph/shader_log.h"
#include "reference/reference_image.h"
#include "scene/shot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

using nlohmann::ordered_json;

namespace {

const std::vector<std::string> k_shared_keys{"shot",         "graph",    "size",   "samples",  "resource", "bounces",
                                             "diffuse_only", "multiple", "frames", "requires", "window"};

int whole_number(const ordered_json& value, int low, int high, const std::string& where, ErrorList& errors) {
    if (value.is_number_integer() && value >= low && value <= high) return value.get<int>();
    errors.add(fmt::format("{}: expected a whole number from {} to {}", where, low, high));
    return low;
}

/// What `object`, the file or a row, says of a row.
void read_row(const ordered_json& object, const std::string& where, ErrorTableRow& row, ErrorList& errors) {
    const auto text = [&](const char* key, std::string& value) {
        if (object.contains(key)) value = text_at(object, key, where, errors, true);
    };
    const auto number = [&](const char* key, int low, int high, auto& value) {
        if (object.contains(key)) value = whole_number(object[key], low, high, where + ", " + key, errors);
    };
    text("shot", row.shot);
    text("graph", row.graph);
    text("resource", row.resource);
    text("requires", row.required_scene);
    number("samples", 1, 1 << 20, row.samples);
    number("bounces", -1, 64, row.bounces);
    number("multiple", 1, 16, row.multiple);
    number("frames", 1, 100000, row.frames);
    number("window", 1, 255, row.window);
    if (row.window % 2 == 0) errors.add(where + ", window: expected an odd number of pixels");
    if (object.contains("diffuse_only")) {
        if (object["diffuse_only"].is_boolean())
            row.diffuse_only = object["diffuse_only"].get<bool>();
        else
            errors.add(where + ", diffuse_only: expected true or false");
    }
    if (object.contains("size")) {
        const ordered_json& size = object["size"];
        if (size.is_array() && size.size() == 2) {
            row.size.x = whole_number(size[0], 1, 16384, where + ", size", errors);
            row.size.y = whole_number(size[1], 1, 16384, where + ", size", errors);
        } else {
            errors.add(where + ", size: expected [width, height]");
        }
    }
    for (const char* key : {"enable", "disable"}) {
        if (!object.contains(key)) continue;
        if (!object[key].is_array()) errors.add(fmt::format("{}, {}: expected a list of passes", where, key));
        for (const ordered_json& pass : object[key])
            row.switches.emplace_back(set_text(pass), std::string(key) == "enable");
    }
    for (const auto& [name, value] : sets_at(object, where, errors))
        row.sets.emplace_back(name, value);
}

/// "voxelization.resolution=256, gather.spiral_cones=31".
std::string auto_values(const GraphModel& model) {
    std::vector<std::string> values;
    for (const std::string& name : model.parameter_names()) {
        const Parameter& p = model.parameter(name);
        if (p.is_auto) values.push_back(name + "=" + to_text(p.info, p.value));
    }
    return join(values, ", ");
}

std::string surface_name(const SurfaceComparison& surface, const Scene& scene) {
    const bool known = surface.material >= 0 && size_t(surface.material) < scene.materials.size();
    const std::string material = known ? scene.materials[size_t(surface.material)].name : "";
    return (material.empty() ? fmt::format("material {}", surface.material) : material) + " " + surface.axis;
}

} // namespace

bool is_error_table(const std::filesystem::path& path) {
    return read_table(path).contains("rows");
}

ErrorTableFile load_error_table(const std::filesystem::path& path) {
    const ordered_json json = read_table(path);
    ErrorList errors;
    ErrorTableFile file;
    std::vector<std::string> known = k_shared_keys;
    known.insert(known.end(), {"about", "surfaces", "metrics", "rows"});
    check_keys(json, "the table", known, errors);
    file.about = text_at(json, "about", "the table", errors, false);
    if (json.contains("surfaces")) file.surfaces = whole_number(json["surfaces"], 0, 16, "surfaces", errors);
    if (json.contains("metrics")) file.metrics = metrics_at(json, "the table", errors);
    ErrorTableRow shared;
    read_row(json, "the table", shared, errors);
    known = k_shared_keys;
    known.insert(known.end(), {"name", "set", "enable", "disable", "adds"});
    if (!json.contains("rows") || !json["rows"].is_array()) errors.add("'rows' must be a list of rows");
    for (const ordered_json& entry : json.value("rows", ordered_json::array())) {
        const std::string where = fmt::format("rows[{}]", file.rows.size());
        if (!entry.is_object()) {
            errors.add(where + ": a row is {\"name\": …, \"graph\": …, \"set\": {…}}");
            continue;
        }
        check_keys(entry, where, known, errors);
        const bool adds = entry.contains("adds") && entry["adds"] == true;
        if (adds && file.rows.empty()) errors.add(where + ": there is no row before that it could add to");
        ErrorTableRow row = adds && !file.rows.empty() ? file.rows.back() : shared;
        row.name = text_at(entry, "name", where, errors, true);
        read_row(entry, where, row, errors);
        if (row.shot.empty()) errors.add(where + ": neither the row nor the table names a shot");
        if (row.graph.empty()) errors.add(where + ": neither the row nor the table names a graph");
        file.rows.push_back(std::move(row));
    }
    errors.throw_if_any(path.string());
    return file;
}

ErrorTableMeasured measure_row(const ErrorTableRow& row, const std::function<void(const std::string&)>& report) {
    ErrorTableMeasured measured;
    if (!row.required_scene.empty()) {
        try {
            find_scene(row.required_scene, ".");
        } catch (const Error&) {
            measured.skipped = row.required_scene + " is not on the scene search path";
            return measured;
        }
    }
    SessionOptions options;
    options.shot = row.shot;
    options.graph = row.graph;
    options.sets = row.sets;
    options.switches = row.switches;
    options.resource = row.resource.find('+') == std::string::npos ? row.resource : "";
    options.size = row.size * row.multiple;
    set_shader_errors_logged(false);
    Session session(options);
    throw_if_broken(session, row.name);
    for (int frame = 0; frame < row.frames; ++frame) {
        if (frame > 0) session.advance();
        session.render(true);
    }
    session.graph().finish_timings();
    throw_if_broken(session, row.name);
    measured.frame_ms = session.graph().frame_ms();
    measured.bytes = session.graph().plan().total_bytes();

    measured.autos = auto_values(session.graph().model());

    ReferenceSettings settings = transport_settings(session.graph().model());
    if (row.bounces) settings.bounces = *row.bounces;
    if (row.diffuse_only) settings.diffuse_only = *row.diffuse_only;
    measured.absolute = !is_radiance(row.resource);
    if (measured.absolute) settings.bounces = 0; // occlusion has none
    Shot shot = load_shot(row.shot);
    shot.width = row.size.x;
    shot.height = row.size.y;
    ReferenceGoal goal;
    goal.samples = row.samples;
    report(fmt::format("{}: reference of {}", row.name, row.shot));
    const LayeredImage truth =
        reference_image(shot, settings, row.frames - 1, goal, [](const ReferenceProgress&) { return true; }).image;
    const LayeredImage picture = averaged_to_size_of(truth, read_parts(session));

    ComparisonOptions comparison;
    comparison.parts = {row.resource};
    comparison.window = row.window;
    const LayerComparison compared = compare_layers(picture, truth, comparison);
    measured.errors = compared.parts.front().figures;
    measured.windowed = compared.parts.front().windowed;
    if (!measured.absolute) {
        for (const SurfaceComparison& surface : compare_surfaces(picture, truth, row.resource, compared.mask)) {
            const auto pixels = size_t(surface.figures["pixels"]);
            if (pixels * 100 >= compared.mask.count())
                measured.surfaces.push_back({surface_name(surface, shot.scene), surface.figures["bias"], pixels});
        }
    }
    return measured;
}

std::string error_table_markdown(const ErrorTableFile& file, const std::vector<ErrorTableMeasured>& measured) {
    const auto percent = [](double share) { return fmt::format("{:+.1f} %", 100 * share); };
    std::vector<std::string> surfaces; // the columns
    for (const ErrorTableMeasured& m : measured) {
        for (const SurfaceError& surface : m.surfaces)
            if (surfaces.size() < size_t(file.surfaces) && surfaces.size() < m.surfaces.size() &&
                std::find(surfaces.begin(), surfaces.end(), surface.name) == surfaces.end())
                surfaces.push_back(surface.name);
        if (!m.surfaces.empty()) break;
    }
    std::string out = "| shot, size | graph | settings |";
    std::string rule = "| --- | --- | --- |";
    for (const std::string& name : file.metrics) {
        out += " " + find_metric(name).title + " |";
        rule += " ---: |";
    }
    const bool windows =
        std::any_of(file.rows.begin(), file.rows.end(), [](const ErrorTableRow& row) { return row.window > 1; });
    if (windows) {
        out += " RMSE of means over N × N pixels |";
        rule += " ---: |";
    }
    if (surfaces.empty()) {
        out += " worst surface |";
        rule += " --- |";
    }
    for (const std::string& surface : surfaces) {
        out += " " + markdown_cell(surface) + " |";
        rule += " ---: |";
    }
    out += " ms | MiB |\n" + rule + " ---: | ---: |\n";
    for (size_t i = 0; i < measured.size(); ++i) {
        const ErrorTableRow& row = file.rows[i];
        const ErrorTableMeasured& m = measured[i];
        out += fmt::format("| {}, {}×{}{} | `{}` | {} |", markdown_cell(row.shot), row.size.x, row.size.y,
                           row.multiple > 1 ? fmt::format(" (rendered at {} times)", row.multiple) : "",
                           markdown_cell(row.graph),
                           markdown_cell(row.name + (m.autos.empty() ? "" : " (" + m.autos + ")")));
        if (!m.skipped.empty()) {
            out += fmt::format(" skipped: {} |\n", markdown_cell(m.skipped));
            continue;
        }
        for (const std::string& name : file.metrics)
            out += " " + metric_text(find_metric(name), m.errors, m.absolute) + " |";
        if (windows && row.window > 1)
            out += fmt::format(" {} ({}×{}) |", metric_text(find_metric("relative_rmse"), m.windowed, m.absolute),
                               row.window, row.window);
        else if (windows)
            out += " |";
        if (surfaces.empty()) {
            const auto worst = std::max_element(
                m.surfaces.begin(), m.surfaces.end(),
                [](const SurfaceError& a, const SurfaceError& b) { return std::abs(a.bias) < std::abs(b.bias); });
            out += worst == m.surfaces.end()
                       ? " |"
                       : fmt::format(" {} {} |", markdown_cell(worst->name), percent(worst->bias));
        }
        for (const std::string& surface : surfaces) {
            const auto found = std::find_if(m.surfaces.begin(), m.surfaces.end(),
                                            [&](const SurfaceError& s) { return s.name == surface; });
            out += found == m.surfaces.end() ? " |" : " " + percent(found->bias) + " |";
        }
        out += fmt::format(" {:.0f} | {:.1f} |\n", m.frame_ms, double(m.bytes) / (1 << 20));
    }
    return out;
}

} // namespace bounce
