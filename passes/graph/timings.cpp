#include "graph/timings.h"

#include <algorithm>
#include <numeric>

namespace bounce {

static constexpr size_t k_kept = 120;

static void push(std::deque<double>& values, double value) {
    values.push_back(value);
    if (values.size() > k_kept) values.pop_front();
}

void Timings::begin(const std::string& id, size_t step, size_t steps) {
    Times& times = times_[id];
    if (times.parts.size() != steps) {
        times.parts.clear();
        times.parts.resize(steps);
        std::erase(times.pending, true); // their timers are gone
    }
    times.skipped = false;
    auto& timer = times.parts[step].timer;
    if (!timer) timer = std::make_unique<GpuTimer>(mode_);
    if (timer->begin() && step == 0) times.pending.push_back(true);
}

void Timings::end(const std::string& id, size_t step) {
    Times& times = times_[id];
    times.parts[step].timer->end();
    take(times);
}

void Timings::drop(const std::string& id) {
    Times& times = times_[id];
    times.parts.clear();
    std::erase(times.pending, true);
}

void Timings::skip(const std::string& id) {
    Times& times = times_[id];
    times.skipped = true;
    times.pending.push_back(false);
    take(times);
}

void Timings::take(Times& times) {
    for (Part& part : times.parts) {
        if (!part.timer) continue;
        while (auto ms = part.timer->take())
            part.ready.push_back(*ms);
    }
    auto has_all = [&] {
        return !times.parts.empty() &&
               std::all_of(times.parts.begin(), times.parts.end(), [](auto& part) { return !part.ready.empty(); });
    };
    while (!times.pending.empty()) {
        if (times.pending.front() && !has_all()) break;
        double sum = 0;
        for (Part& part : times.parts) {
            if (!times.pending.front()) break;
            sum += part.ready.front();
            part.ready.pop_front();
        }
        if (times.pending.front()) {
            times.last = sum;
            push(times.runs, sum);
        }
        push(times.frames, sum);
        times.pending.pop_front();
    }
}

void Timings::take() {
    for (auto& [id, times] : times_)
        take(times);
}

void Timings::forget() {
    for (auto& [id, times] : times_) {
        times.runs.clear();
        times.frames.clear();
    }
}

PassTiming Timings::of(const std::string& id) const {
    PassTiming timing;
    auto found = times_.find(id);
    if (found == times_.end()) return timing;
    const Times& times = found->second;
    timing.unchanged = times.skipped;
    timing.last = timing.median = timing.low = timing.high = times.last;
    if (!times.frames.empty())
        timing.per_frame = std::accumulate(times.frames.begin(), times.frames.end(), 0.0) / double(times.frames.size());
    if (times.runs.empty()) return timing;
    std::vector<double> sorted(times.runs.begin(), times.runs.end());
    timing.last = sorted.back();
    std::sort(sorted.begin(), sorted.end());
    auto at = [&](double share) { return sorted[size_t(share * double(sorted.size() - 1) + 0.5)]; };
    timing.median = at(0.5);
    timing.low = at(0.1);
    timing.high = at(0.9);
    timing.samples = int(sorted.size());
    return timing;
}

} // namespace bounce
