#include "app/experiments/chart_point.h"

#include "app/experiments/transport.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace bounce {

using nlohmann::ordered_json;

std::string PointTask::label() const {
    std::string text = fmt::format("{} · {}", shot, graph);
    for (const auto& [name, value] : values)
        text += fmt::format(" · {}={}", name, value);
    return text;
}

std::string PointTask::command() const {
    std::string text = fmt::format("bounce render {} --graph {} --size {}x{} --frames {}", shot, graph, size.x, size.y,
                                   warm_up + frames);
    for (const auto& [name, value] : values)
        text += fmt::format(" --set {}={}", name, value);
    return text + " --timings t.json -o x.exr";
}

std::string PointTask::key() const {
    std::string text = fmt::format("{} {} {} {}", command(), frames, reference_noise, reference_samples);
    for (const std::string& part : parts)
        text += " " + part;
    // FNV-1a, 64 bits: short, stable across machines and versions of the standard library.
    uint64_t hash = 14695981039346656037ull;
    for (unsigned char c : text)
        hash = (hash ^ c) * 1099511628211ull;
    return fmt::format("{:016x}", hash);
}

static ordered_json error_json(const PointError& e) {
    return {{"mean", e.mean},
            {"reference_mean", e.reference_mean},
            {"rmse_without_noise", e.rmse_without_noise},
            {"bias", e.bias},
            {"rmse", e.rmse},
            {"relative_rmse", e.relative_rmse},
            {"relative_mse", e.relative_mse},
            {"p99", e.p99},
            {"flip", e.flip},
            {"ssim", e.ssim},
            {"reference_noise", e.reference_noise}};
}

static PointError error_of(const ordered_json& j) {
    PointError e;
    e.mean = j.value("mean", 0.0); // points of before have none
    e.reference_mean = j.value("reference_mean", 0.0);
    e.rmse_without_noise = j.value("rmse_without_noise", 0.0);
    e.bias = j.at("bias");
    e.rmse = j.at("rmse");
    e.relative_rmse = j.at("relative_rmse");
    e.relative_mse = j.at("relative_mse");
    e.p99 = j.at("p99");
    e.flip = j.at("flip");
    e.ssim = j.at("ssim");
    e.reference_noise = j.at("reference_noise");
    return e;
}

std::string point_to_json(const ChartPoint& p) {
    ordered_json j;
    j["key"] = p.key;
    j["shot"] = p.task.shot;
    j["graph"] = p.task.graph;
    j["values"] = ordered_json::object();
    for (const auto& [name, value] : p.task.values)
        j["values"][name] = value;
    j["size"] = {p.task.size.x, p.task.size.y};
    j["warm_up"] = p.task.warm_up;
    j["frames"] = p.task.frames;
    j["reference_goal"] = {{"noise", p.task.reference_noise}, {"samples", p.task.reference_samples}};
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
    j["declined"] = ordered_json::array();
    for (const auto& [id, reason] : p.declined)
        j["declined"].push_back({{"id", id}, {"reason", reason}});
    j["transport_bounces"] = p.transport_bounces;
    j["parts"] = p.parts;
    if (!p.task.parts.empty()) j["compared_parts"] = p.task.parts;
    j["same_transport"] = error_json(p.same_transport);
    j["full"] = error_json(p.full);
    j["kept_share"] = p.kept_share;
    j["renderer"] = p.renderer;
    j["commit"] = p.commit;
    j["thumbnail_png"] = p.thumbnail_png;
    j["error_png"] = p.error_png;
    return json_dump(j, 1) + "\n";
}

ChartPoint point_from_json(const std::string& text, const std::string& where) {
    try {
        ordered_json j = parse_json<ordered_json>(text, where);
        ChartPoint p;
        p.key = j.at("key");
        p.task.shot = j.at("shot");
        p.task.graph = j.at("graph");
        for (const auto& [name, value] : j.at("values").items())
            p.task.values.emplace_back(name, value.get<std::string>());
        p.task.size = {j.at("size").at(0), j.at("size").at(1)};
        p.task.warm_up = j.at("warm_up");
        p.task.frames = j.at("frames");
        p.task.reference_noise = j.at("reference_goal").at("noise");
        p.task.reference_samples = j.at("reference_goal").at("samples");
        p.total_ms = j.at("total_ms");
        p.bytes = j.at("bytes");
        for (const auto& pass : j.at("passes")) {
            p.passes.push_back(
                {pass.at("id"), pass.at("median_ms"), pass.at("p10_ms"), pass.at("p90_ms"), pass.at("bytes")});
        }
        for (const auto& d : j.at("declined"))
            p.declined.emplace_back(d.at("id"), d.at("reason"));
        p.transport_bounces = j.at("transport_bounces");
        p.parts = j.value("parts", std::vector<std::string>{});
        p.task.parts = j.value("compared_parts", std::vector<std::string>{});
        p.same_transport = error_of(j.at("same_transport"));
        p.full = error_of(j.at("full"));
        p.kept_share = j.at("kept_share");
        p.renderer = j.at("renderer");
        p.commit = j.at("commit");
        p.thumbnail_png = j.at("thumbnail_png");
        p.error_png = j.at("error_png");
        return p;
    } catch (const ordered_json::exception& error) {
        throw Error(where + ": no point of a chart: " + json_problem(error));
    }
}

bool ChartPoint::absolute() const {
    return only_occlusion(parts);
}

double ChartPoint::shown_error() const {
    return absolute() ? same_transport.rmse : same_transport.relative_rmse;
}

void mark_pareto(std::vector<ChartPoint>& points) {
    for (ChartPoint& point : points) {
        point.on_front = std::none_of(points.begin(), points.end(), [&](const ChartPoint& other) {
            if (other.task.shot != point.task.shot) return false;
            bool no_worse = other.total_ms <= point.total_ms && other.shown_error() <= point.shown_error();
            bool better = other.total_ms < point.total_ms || other.shown_error() < point.shown_error();
            return no_worse && better;
        });
    }
}

} // namespace bounce
