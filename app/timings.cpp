#include "app/timings.h"

#include "app/capture.h"
#include "core/image.h"

#include <cstdlib>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bounce {

uint64_t bytes_of_pass(const Plan& plan, const std::string& id) {
    uint64_t bytes = 0;
    for (const PlanResource& resource : plan.resources) {
        if (!resource.writers.empty() && resource.writers.front() == id) bytes += resource.total_bytes();
    }
    return bytes;
}

static double mib(uint64_t bytes) {
    return double(bytes) / (1024.0 * 1024.0);
}

std::string timing_table(const Session& session) {
    const Graph& graph = session.graph();
    std::string out = fmt::format("{:<24} {:>10} {:>18} {:>10}\n", "pass",
                                  std::getenv("BOUNCE_CPU_TIME") ? "CPU ms" : "GPU ms", "10 … 90 %", "MiB");
    for (const PlanPass& pass : graph.plan().passes) {
        PassTiming t = graph.timing(pass.id);
        std::string spread = t.unchanged ? "unchanged" : fmt::format("{:.3f} … {:>7.3f}", t.low, t.high);
        out += fmt::format("{:<24} {:>10.3f} {:>18} {:>10.2f}\n", pass.id, t.unchanged ? t.last : t.median, spread,
                           mib(bytes_of_pass(graph.plan(), pass.id)));
    }
    bool on_change = graph.model().rebuild() == Rebuild::on_change;
    out +=
        fmt::format("{:<24} {:>10.3f} {:>18} {:>10.2f}\n", on_change ? "a frame, on the mean" : "all passes",
                    graph.frame_ms(), on_change ? "rebuild on_change" : "every_frame", mib(graph.plan().total_bytes()));
    out += fmt::format("{:<24} {:>10} {:>18} {:>10.2f}\n", "scene (geometry, textures)", "", "",
                       mib(session.gpu_scene().geometry_bytes() + session.gpu_scene().texture_bytes()));
    for (const CounterValue& counter : graph.counters())
        out += fmt::format("{}: {} {}{}\n", counter.pass, counter.value, counter.label, counter.bad() ? " (!)" : "");
    for (const PlanSkip& skipped : graph.plan().skipped)
        out += fmt::format("{}: skipped: {}\n", skipped.id, skipped.reason);
    return out;
}

std::string time_text(const PassTiming& timing) {
    if (timing.unchanged) {
        return fmt::format("unchanged: none of its inputs differs, so what it made stands (graph.rebuild=on_change)\n"
                           "its last run took GPU {:.3f} ms",
                           timing.last);
    }
    if (!timing.samples && timing.last > 0)
        return fmt::format("GPU {:.3f} ms with earlier settings; the present ones have not been measured yet",
                           timing.last);
    if (!timing.samples) return "not timed yet";
    return fmt::format("GPU {:.3f} ms, median of {} runs\n10 to 90 % lie from {:.3f} to {:.3f} ms", timing.median,
                       timing.samples, timing.low, timing.high);
}

void write_timings(const Session& session, const std::filesystem::path& path) {
    const Graph& graph = session.graph();
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(picture_metadata(session, ""));
    json["passes"] = nlohmann::ordered_json::array();
    for (const PlanPass& pass : graph.plan().passes) {
        PassTiming t = graph.timing(pass.id);
        json["passes"].push_back({{"id", pass.id},
                                  {"median_ms", t.median},
                                  {"p10_ms", t.low},
                                  {"p90_ms", t.high},
                                  {"frames", t.samples},
                                  {"unchanged", t.unchanged},
                                  {"last_run_ms", t.last},
                                  {"ms_per_frame", t.per_frame},
                                  {"bytes", bytes_of_pass(graph.plan(), pass.id)}});
    }
    json["counters"] = nlohmann::ordered_json::array();
    for (const CounterValue& c : graph.counters())
        json["counters"].push_back({{"id", c.pass}, {"label", c.label}, {"value", c.value}, {"overflow", c.overflow}});
    json["skipped"] = nlohmann::ordered_json::array();
    for (const PlanSkip& d : graph.plan().skipped)
        json["skipped"].push_back({{"id", d.id}, {"reason", d.reason}});
    json["resources"] = nlohmann::ordered_json::object();
    for (const PlanResource& r : graph.plan().resources)
        json["resources"][r.name()] = r.total_bytes();
    json["rebuild"] = graph.model().rebuild() == Rebuild::on_change ? "on_change" : "every_frame";
    json["total_ms"] = graph.frame_ms();
    json["total_bytes"] = graph.plan().total_bytes();
    write_file_atomically(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

} // namespace bounce
