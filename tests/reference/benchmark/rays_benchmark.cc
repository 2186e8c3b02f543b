// Rays per second of the reference against a bare Embree loop over the very same rays, measured in turns so that both
// see the same machine, on 1, 2, 4 … threads. `share` is the ratio. Usage: bounce_benchmark_reference [benchmark
// options] [SHOT or .gltf …]

#include "core/error.h"
#include "reference/geometry.h"
#include "reference/integrator.h"
#include "reference/render.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <cstdio>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>

using namespace bounce;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Only the calls into Embree, in chunks of the size of the reference's tiles.
double trace_bare(const TraceGeometry& geometry, const std::vector<TracedRay>& rays, int threads) {
    tbb::task_arena arena(threads);
    const auto start = std::chrono::steady_clock::now();
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<size_t>(0, rays.size(), 1024),
            [&](const tbb::blocked_range<size_t>& range) {
                size_t hits = 0;
                for (size_t i = range.begin(); i < range.end(); ++i) {
                    const TracedRay& ray = rays[i];
                    hits += ray.shadow ? geometry.occluded(ray.origin, ray.direction, ray.length)
                                       : geometry.intersect(ray.origin, ray.direction, ray.length).valid();
                }
                benchmark::DoNotOptimize(hits);
            },
            tbb::simple_partitioner());
    });
    return seconds_since(start);
}

void compare(benchmark::State& state, const std::string& name) {
    const int threads = int(state.range(0));
    Shot shot;
    try {
        shot = load_shot(name);
    } catch (const Error& error) {
        state.SkipWithError(error.what());
        return;
    }
    shot.width = 192;
    shot.height = 108;
    if (shot.scene.lights.empty() && !shot.environment.present()) shot.environment.radiance = glm::vec3(1);
    ReferenceSettings settings;
    settings.threads = threads;
    ReferenceRender render(shot, settings);
    constexpr int k_samples = 8; // as many as the reference takes together
    render.step(k_samples);
    double reference_seconds = 0, bare_seconds = 0, count = 0;
    int sample = k_samples;
    for (auto _ : state) {
        const std::vector<TracedRay> rays = render.rays_of_samples(sample, sample + k_samples);
        const uint64_t before = render.rays();
        const auto start = std::chrono::steady_clock::now();
        render.step(k_samples);
        const double seconds = seconds_since(start);
        if (render.rays() - before != rays.size()) state.SkipWithError("the two did not trace the same rays");
        reference_seconds += seconds;
        bare_seconds += trace_bare(render.scene().geometry, rays, threads);
        count += double(rays.size());
        sample += k_samples;
        state.SetIterationTime(seconds);
    }
    state.counters["rays_per_s"] = count / reference_seconds;
    state.counters["bare_rays_per_s"] = count / bare_seconds;
    state.counters["share"] = bare_seconds / reference_seconds;
}

} // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty()) names = {"sponza", "sibenik", "cornell", "atrium"};
    for (const std::string& name : names) {
        auto* registered = benchmark::RegisterBenchmark(name.c_str(), compare, name);
        registered->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(8)->ArgName("threads");
        const int most = int(std::max(1u, std::thread::hardware_concurrency()));
        for (int threads = 1; threads < most; threads *= 2)
            registered->Arg(threads);
        registered->Arg(most);
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
