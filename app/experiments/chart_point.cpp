#include "app/experiments/chart_point.h"

#include "app/experiments/point_check.h"
#include "app/experiments/transport.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace bounce {

using nlohmann::ordered_json;

std::string PointTask::label() const {
    std::string text = fmt::format("{} · {}", session.shot, session.graph);
    for (const auto& [name, value] : session.sets)
        text += fmt::format(" · {}={}", name, value);
    for (const auto& [id, on] : session.switches)
        text += fmt::format(" · {}{}", on ? "+" : "-", id);
    return text;
}

std::string PointTask::command() const {
    std::string text = fmt::format("bounce render {} --graph {} --size {}x{} --frames {}", session.shot, session.graph,
                                   size().x, size().y, warm_up + frames);
    for (const auto& [name, value] : session.sets)
        text += fmt::format(" --set {}={}", name, value);
    for (const auto& [id, on] : session.switches)
        text += fmt::format(" {} {}", on ? "--enable" : "--disable", id);
    return text + " --timings t.json -o x.exr";
}

std::string PointTask::rebuild() const {
    for (const auto& [name, value] : session.sets)
        if (name == "graph.rebuild") return value;
    return "every_frame";
}

std::string PointTask::name() const {
    std::string text = fmt::format("{} {} {} {}", command(), frames, reference_noise, reference_samples);
    if (device_reference) text += " device";
    for (const std::string& part : parts)
        text += " " + part;
    if (bounces) text += fmt::format(" bounces {}", *bounces);
    if (diffuse_only) text += fmt::format(" diffuse_only {}", *diffuse_only);
    if (thorough) text += " thorough";
    return text;
}

std::string point_key(const PointTask& task, const PointContent& content) {
    std::string text = task.name() + "\n" + content.commit + "\n" + content.graph + "\n" + content.shot;
    for (const auto& [pass, digest] : content.shaders)
        text += "\n" + pass + " " + digest;
    // FNV-1a, 64 bits: short, stable across machines and versions of the standard library.
    uint64_t hash = 14695981039346656037ull;
    for (unsigned char c : text)
        hash = (hash ^ c) * 1099511628211ull;
    return fmt::format("{:016x}", hash);
}

static ordered_json content_json(const PointContent& content) {
    return {{"commit", content.commit}, {"graph", content.graph}, {"shot", content.shot}, {"shaders", content.shaders}};
}

static PointContent content_of(const ordered_json& json) {
    PointContent content;
    content.commit = json.at("commit");
    content.graph = json.at("graph");
    content.shot = json.at("shot");
    for (const auto& [pass, digest] : json.at("shaders").items())
        content.shaders[pass] = digest.get<std::string>();
    return content;
}

std::string point_to_json(const ChartPoint& p) {
    ordered_json j;
    j["key"] = p.key;
    const SessionOptions& session = p.task.session;
    j["shot"] = session.shot;
    j["graph"] = session.graph;
    j["values"] = ordered_json::object();
    for (const auto& [name, value] : session.sets)
        j["values"][name] = value;
    for (const auto& [id, on] : session.switches)
        j["switches"][id] = on;
    j["size"] = {p.task.size().x, p.task.size().y};
    j["warm_up"] = p.task.warm_up;
    j["frames"] = p.task.frames;
    j["reference_goal"] = {{"noise", p.task.reference_noise}, {"samples", p.task.reference_samples}};
    if (p.task.device_reference) j["reference_goal"]["by"] = "device";
    if (p.task.bounces) j["reference_goal"]["bounces"] = *p.task.bounces;
    if (p.task.diffuse_only) j["reference_goal"]["diffuse_only"] = *p.task.diffuse_only;
    j["command"] = p.task.command();
    j["total_ms"] = p.total_ms;
    j["bytes"] = p.bytes;
    j["passes"] = ordered_json::array();
    for (const PassCost& pass : p.passes) {
        j["passes"].push_back({{"id", pass.id},
                               {"median_ms", pass.median_ms},
                               {"p10_ms", pass.low_ms},
                               {"p90_ms", pass.high_ms},
                               {"bytes", pass.bytes}});
    }
    j["skipped"] = ordered_json::array();
    for (const auto& [id, reason] : p.skipped)
        j["skipped"].push_back({{"id", id}, {"reason", reason}});
    j["transport_bounces"] = p.transport_bounces;
    j["parts"] = p.parts;
    if (!p.task.parts.empty()) j["compared_parts"] = p.task.parts;
    j["same_transport"] = metrics_json(p.same_transport);
    j["full"] = metrics_json(p.full);
    j["kept_share"] = p.kept_share;
    j["renderer"] = p.renderer;
    j["driver"] = p.driver;
    j["machine"] = p.machine;
    j["measured"] = p.measured;
    j["content"] = content_json(p.content);
    j["thumbnail_png"] = p.thumbnail_png;
    j["error_png"] = p.error_png;
    if (p.figures) {
        j["figures"] = figures_json(*p.figures);
        j["reference_png"] = p.reference_png;
    }
    return json_dump(j, 1) + "\n";
}

ChartPoint point_from_json(const std::string& text, const std::string& where) {
    try {
        ordered_json j = parse_json<ordered_json>(text, where);
        ChartPoint p;
        p.key = j.at("key");
        SessionOptions& session = p.task.session;
        session.shot = j.at("shot");
        session.graph = j.at("graph");
        for (const auto& [name, value] : j.at("values").get_ref<const ordered_json::object_t&>())
            session.sets.emplace_back(name, value.get<std::string>());
        const ordered_json switches = j.value("switches", ordered_json::object());
        for (const auto& [id, on] : switches.get_ref<const ordered_json::object_t&>())
            session.switches.emplace_back(id, on.get<bool>());
        session.size = glm::ivec2(j.at("size").at(0), j.at("size").at(1));
        p.task.warm_up = j.at("warm_up");
        p.task.frames = j.at("frames");
        p.task.reference_noise = j.at("reference_goal").at("noise");
        p.task.reference_samples = j.at("reference_goal").at("samples");
        p.task.device_reference = j.at("reference_goal").value("by", "cpu") == "device";
        const ordered_json& goal = j.at("reference_goal");
        if (goal.contains("bounces")) p.task.bounces = goal["bounces"].get<int>();
        if (goal.contains("diffuse_only")) p.task.diffuse_only = goal["diffuse_only"].get<bool>();
        p.total_ms = j.at("total_ms");
        p.bytes = j.at("bytes");
        for (const auto& pass : j.at("passes")) {
            p.passes.push_back(
                {pass.at("id"), pass.at("median_ms"), pass.at("p10_ms"), pass.at("p90_ms"), pass.at("bytes")});
        }
        for (const auto& d : j.at("skipped"))
            p.skipped.emplace_back(d.at("id"), d.at("reason"));
        p.transport_bounces = j.at("transport_bounces");
        p.parts = j.value("parts", std::vector<std::string>{});
        p.task.parts = j.value("compared_parts", std::vector<std::string>{});
        p.same_transport = metrics_from_json(j.at("same_transport"));
        p.full = metrics_from_json(j.at("full"));
        p.kept_share = j.at("kept_share");
        p.renderer = j.at("renderer");
        p.driver = j.value("driver", ""); // points of before have none of these
        p.machine = j.value("machine", "");
        p.measured = j.value("measured", "");
        if (j.contains("content")) p.content = content_of(j["content"]);
        p.thumbnail_png = j.at("thumbnail_png");
        p.error_png = j.at("error_png");
        p.task.thorough = j.contains("figures");
        if (p.task.thorough) {
            p.figures = figures_from_json(j["figures"]);
            p.reference_png = j.at("reference_png");
        }
        check_point(p, where);
        return p;
    } catch (const ordered_json::exception& error) {
        throw Error(where + ": not a point of a chart: " + json_problem(error));
    }
}

bool ChartPoint::absolute() const {
    return only_occlusion(parts);
}

double ChartPoint::error(const Metric& metric) const {
    const Metric& shown = metric_for(metric, absolute());
    return std::abs(same_transport[shown.name] - shown.ideal);
}

static std::string transport_of(const ChartPoint& point) {
    return transport_text(point.transport_bounces, point.parts);
}

void mark_pareto(std::vector<ChartPoint>& points, const Metric& metric) {
    for (ChartPoint& point : points) {
        point.on_front = std::none_of(points.begin(), points.end(), [&](const ChartPoint& other) {
            if (other.task.session.shot != point.task.session.shot || transport_of(other) != transport_of(point))
                return false;
            const double error = point.error(metric), other_error = other.error(metric);
            bool no_worse = other.total_ms <= point.total_ms && other_error <= error;
            bool better = other.total_ms < point.total_ms || other_error < error;
            return no_worse && better;
        });
    }
}

} // namespace bounce
