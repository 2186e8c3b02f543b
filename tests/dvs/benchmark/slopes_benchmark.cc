// How the stages of dvs grow: voxelization with triangles (a bumpy plane, finer and finer) and with voxels, the filter
// and the bounce with voxels, the gather with pixels. Google Benchmark fits a line through the times (BigO: the cost of
// one; RMS: how far from a line they lie). Times are what the graph's own timers tell, medians of a few frames; with
// BOUNCE_CPU_TIME in the environment processor time.
#include "support/pass_cost.h"
#include "support/temp_folder.h"
#include "support/waves.h"

using namespace bounce;

namespace {

/// Everything is voxelized in each frame.
double measure(const std::string& shot, glm::ivec2 size, int resolution, const std::vector<std::string>& ids) {
    return pass_cost(shot, "dvs", size,
                     {{"voxelization.resolution", std::to_string(resolution)}, {"voxelization.static_once", "false"}},
                     ids);
}

void voxelization_by_triangles(benchmark::State& state) {
    TempFolder folder;
    int side = int(state.range(0));
    std::string shot = waves(folder, side);
    for (auto _ : state)
        state.SetIterationTime(measure(shot, {16, 16}, 64, {"voxelization"}) * 1e-3);
    state.SetComplexityN(int64_t(2) * side * side);
}

void by_voxels(benchmark::State& state, const std::vector<std::string>& ids) {
    int side = int(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(measure("cornell", {16, 16}, side, ids) * 1e-3);
    state.SetComplexityN(int64_t(side) * side * side);
}

void gather_by_pixels(benchmark::State& state) {
    int side = int(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(measure("cornell", glm::ivec2(side), 64, {"gather"}) * 1e-3);
    state.SetComplexityN(int64_t(side) * side);
}

void resolutions(benchmark::internal::Benchmark* b) {
    b->RangeMultiplier(2)->Range(32, 256);
    as_lines(b);
}

} // namespace

BENCHMARK(voxelization_by_triangles)->RangeMultiplier(2)->Range(64, 512)->Apply(as_lines);
BENCHMARK_CAPTURE(by_voxels, voxelization, {"voxelization"})->Apply(resolutions);
BENCHMARK_CAPTURE(by_voxels, filter, {"filter"})->Apply(resolutions);
BENCHMARK_CAPTURE(by_voxels, bounce, {"voxel_bounce"})->Apply(resolutions);
BENCHMARK(gather_by_pixels)->DenseRange(64, 256, 64)->Apply(as_lines);

int main(int argc, char** argv) {
    return run_benchmarks(argc, argv);
}
