// How layered depth maps cost: construction with the number of maps, with texels a map, and with triangles (a wavy
// plane, finer and finer); ambient occlusion with maps and with pixels; photon tracing and splatting with photons.
// Google Benchmark fits a line through the times (BigO: the cost of one; RMS: how far from a line they lie). Times are
// what the graph's own timers tell; with BOUNCE_CPU_TIME in the environment processor time.
#include "support/pass_cost.h"
#include "support/waves.h"

using namespace bounce;

namespace {

void by_maps(benchmark::State& state, const std::string& id) {
    std::string maps = std::to_string(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(
            pass_cost("cornell", "ldm_ao", {64, 64}, {{"ldm.maps", maps}, {"ldm.resolution", "50"}}, {id}) * 1e-3);
    state.SetComplexityN(state.range(0));
}

void construction_by_texels(benchmark::State& state) {
    std::string side = std::to_string(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(
            pass_cost("cornell", "ldm_ao", {16, 16}, {{"ldm.maps", "64"}, {"ldm.resolution", side}}, {"ldm"}) * 1e-3);
    state.SetComplexityN(state.range(0) * state.range(0));
}

void construction_by_triangles(benchmark::State& state) {
    TempFolder folder;
    std::string shot = waves(folder, int(state.range(0)));
    for (auto _ : state)
        state.SetIterationTime(
            pass_cost(shot, "ldm_ao", {16, 16}, {{"ldm.maps", "16"}, {"ldm.resolution", "50"}}, {"ldm"}) * 1e-3);
    state.SetComplexityN(2 * state.range(0) * state.range(0));
}

void occlusion_by_pixels(benchmark::State& state) {
    int side = int(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(pass_cost("cornell", "ldm_ao", glm::ivec2(side),
                                         {{"ldm.maps", "64"}, {"ldm.resolution", "50"}}, {"ambient_occlusion"}) *
                               1e-3);
    state.SetComplexityN(int64_t(side) * side);
}

void by_photons(benchmark::State& state, const std::string& id) {
    std::string side = std::to_string(state.range(0));
    for (auto _ : state)
        state.SetIterationTime(pass_cost("cornell", "ldm_indirect_tuned", {64, 64},
                                         {{"ldm.maps", "32"}, {"ldm.resolution", "50"}, {"rsm.resolution", side}},
                                         {id}) *
                               1e-3);
    state.SetComplexityN(32 * state.range(0) * state.range(0));
}

} // namespace

BENCHMARK_CAPTURE(by_maps, construction, "ldm")->RangeMultiplier(2)->Range(32, 512)->Apply(as_lines);
BENCHMARK_CAPTURE(by_maps, ambient_occlusion, "ambient_occlusion")->RangeMultiplier(2)->Range(32, 512)->Apply(as_lines);
BENCHMARK(construction_by_texels)->DenseRange(50, 250, 50)->Apply(as_lines);
BENCHMARK(construction_by_triangles)->RangeMultiplier(2)->Range(32, 256)->Apply(as_lines);
BENCHMARK(occlusion_by_pixels)->DenseRange(64, 256, 64)->Apply(as_lines);
BENCHMARK_CAPTURE(by_photons, tracing, "photons")->DenseRange(32, 128, 32)->Apply(as_lines);
BENCHMARK_CAPTURE(by_photons, splatting, "splat")->DenseRange(32, 128, 32)->Apply(as_lines);

int main(int argc, char** argv) {
    return run_benchmarks(argc, argv);
}
