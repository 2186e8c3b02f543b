#include "app/ui/timeline.h"

#include "app/ui/live_comparison.h"
#include "gpu/barrier.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bounce {

float TimelineFrame::passes_ms() const {
    return std::accumulate(passes.begin(), passes.end(), 0.0f);
}

/// NaN where the picture has another size than before.
float Timeline::change_of(const Session& session) {
    const GpuTexture* display = session.graph().texture("out.display");
    if (!wants_change || !display || !*display) {
        display_.clear();
        return -1;
    }
    const glm::ivec3 size = display->desc().size;
    std::vector<uint8_t> now(size_t(size.x) * size_t(size.y) * 4);
    memory_barrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(display->id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(now.size()), now.data());
    float change = -1;
    if (display_.size() == now.size()) {
        uint64_t sum = 0;
        for (size_t i = 0; i < now.size(); ++i)
            if (i % 4 != 3) sum += uint64_t(std::abs(int(now[i]) - int(display_[i])));
        change = float(double(sum) / (255.0 * 0.75 * double(now.size())));
    }
    display_ = std::move(now);
    return change;
}

void Timeline::add(const Session& session, float ms, const LiveComparison* comparison, const std::string& settings) {
    const Graph& graph = session.graph();
    TimelineFrame frame;
    frame.number = ++added_;
    frame.shot_frame = session.frame();
    frame.ms = ms;
    frame.bytes = graph.plan().total_bytes();
    for (const PlanPass& pass : graph.plan().passes) {
        auto place = std::find(passes.begin(), passes.end(), pass.id);
        if (place == passes.end()) place = passes.insert(place, pass.id);
        frame.passes.resize(std::max(frame.passes.size(), size_t(place - passes.begin()) + 1), 0.0f);
        const PassTiming timing = graph.timing(pass.id);
        frame.passes[size_t(place - passes.begin())] = timing.unchanged ? 0 : float(timing.last);
    }
    frame.settings_changed = settings != settings_ && !settings_.empty();
    settings_ = settings;
    frame.change = change_of(session);
    if (comparison && comparison->measured() && !comparison->stale(session)) {
        const auto error = comparison->figures().find(comparison->metric);
        if (error && std::isfinite(*error)) frame.error = std::abs(float(*error));
    }
    frames.push_back(std::move(frame));
    if (frames.size() > k_kept) frames.pop_front();
}

const TimelineFrame* Timeline::shown() const {
    const auto found =
        std::find_if(frames.begin(), frames.end(), [&](const TimelineFrame& frame) { return frame.number == pinned; });
    if (found != frames.end()) return &*found;
    return frames.empty() ? nullptr : &frames.back();
}

} // namespace bounce
