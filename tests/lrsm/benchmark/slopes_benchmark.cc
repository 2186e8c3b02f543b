// How the stages of lrsm_tuned grow: the gather with pixels, the layers with texels of the reflective shadow map, the
// occlusion voxels with voxels. Google Benchmark fits a line through the times (BigO: the cost of one; RMS: how far
// from a line they lie). Times are what the graph's own timers tell, medians of a few frames.
#include "support/pass_cost.h"

using namespace bounce;

namespace {

/// With one parameter changed or another picture size.
double measure(int side, const std::string& parameter, int value, const std::vector<std::string>& ids) {
    Sets sets;
    if (!parameter.empty()) sets.emplace_back(parameter, std::to_string(value));
    return pass_cost("cornell", "lrsm_tuned", glm::ivec2(side), sets, ids);
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

BENCHMARK(gather_by_pixels)->DenseRange(64, 256, 64)->Apply(as_lines);
BENCHMARK(layers_by_texels)->RangeMultiplier(2)->Range(128, 1024)->Apply(as_lines);
BENCHMARK(occlusion_by_voxels)->RangeMultiplier(2)->Range(32, 256)->Apply(as_lines);

int main(int argc, char** argv) {
    return run_benchmarks(argc, argv);
}
