#pragma once
// What passes cost, for benchmarks of slopes: the graph's own timers (with BOUNCE_CPU_TIME in the environment processor
// time), medians of a few frames after all is compiled and grown.

#include "app/hosts/headless.h"
#include "app/session.h"

#include <benchmark/benchmark.h>

namespace bounce {

using Sets = std::vector<std::pair<std::string, std::string>>;

/// Milliseconds of the passes `ids` together. Errors: those of a Session.
inline double pass_cost(const std::string& shot, const std::string& graph, glm::ivec2 size, const Sets& sets,
                        const std::vector<std::string>& ids) {
    SessionOptions options;
    options.shot = shot;
    options.graph = graph;
    options.size = size;
    options.sets = sets;
    Session session(options);
    for (int frame = 0; frame < 5; ++frame) {
        if (frame == 2) session.graph().forget_timings(); // compiled, grown and warm
        session.render(frame < 2);
        session.advance();
    }
    session.graph().finish_timings();
    double ms = 0;
    for (const std::string& id : ids)
        ms += session.graph().timing(id).median;
    return ms;
}

/// One measurement, a line fitted through the costs.
inline void as_lines(benchmark::internal::Benchmark* b) {
    b->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
}

inline int run_benchmarks(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    HeadlessContext context;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

} // namespace bounce
