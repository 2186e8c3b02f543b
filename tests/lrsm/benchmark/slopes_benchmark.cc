// How the stages of lrsm_tuned grow: the gather with pixels, the layers with texels of the reflective shadow map, the
// occlusion voxels with voxels. Google Benchmark fits a line through the times (BigO: the cost of one; RMS: how far
// from a line they lie). Times are what the graph's own timers tell, medians of a few frames.
#include "app/hosts/headless.h"
#include "app/session.h"

#include <benchmark/benchmark.h>

using namespace bounce;

namespace {

/// Milliseconds of the passes `ids` together, with one parameter changed or another picture size.
double measure(int side, const std::string& parameter, int value, const std::vector<std::string>& ids) {
    SessionOptions options;
    options.shot = "cornell";
    options.graph = "lrsm_tuned";
    options.size = glm::ivec2(side);
    if (!parameter.empty()) options.sets.emplace_back(parameter, std::to_string(value));
    Session session(options);
    for (int frame = 0; frame < 5; ++frame) {
        if (frame == 2) session.graph().forget_timings(); // compiled and warm
        session.render();
        session.advance();
    }
    session.graph().finish_timings();
    double ms = 0;
    for (const std::string& id : ids)
        ms += session.graph().timing(id).median;
    return ms;
}

void gather_by_pixels(benchmark::State& state) {
    int side = int(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(measure(side, "", 0, {"gather", "shade"}) * 1e-3);
    state.SetComplexityN(int64_t(side) * side);
}

void layers_by_texels(benchmark::State& state) {
    int side = int(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(measure(64, "rsm.resolution", side, {"rsm", "lrsm_layers", "lrsm_mips"}) * 1e-3);
    state.SetComplexityN(int64_t(side) * side);
}

void occlusion_by_voxels(benchmark::State& state) {
    int side = int(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(measure(64, "occlusion_voxels.resolution", side, {"occlusion_voxels", "voxel_mips"}) *
                               1e-3);
    state.SetComplexityN(int64_t(side) * side * side);
}

} // namespace

BENCHMARK(gather_by_pixels)
    ->DenseRange(64, 256, 64)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);
BENCHMARK(layers_by_texels)
    ->RangeMultiplier(2)
    ->Range(128, 1024)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);
BENCHMARK(occlusion_by_voxels)
    ->RangeMultiplier(2)
    ->Range(32, 256)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    HeadlessContext context;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
