#include "reference/reference_image.h"

#include "core/error.h"
#include "reference/state_cache.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <thread>

namespace bounce {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double k_seconds_between_saves = 60;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class GoalRun {
  public:
    GoalRun(ReferenceRender& render, const ReferenceGoal& goal,
            const std::function<bool(const ReferenceProgress&)>& on_progress, bool use_cache)
        : render_(render), goal_(goal), on_progress_(on_progress), use_cache_(use_cache) {}

    ReferenceResult run() {
        ReferenceResult result;
        if (use_cache_) {
            try {
                resume();
            } catch (const Error& error) {
                // A cache that cannot be used costs time, not the picture.
                problem_ = error.what();
            }
        }
        result.resumed_from = render_.samples();
        started_at_ = render_.samples();
        result.complete = true;
        while (!reached()) {
            rendered_ = true;
            const bool go_on = render_chunk(next_count());
            if (at_checkpoint()) render_.add_checkpoint();
            if (!go_on) {
                result.complete = reached();
                break;
            }
            if (!reached() && use_cache_ && seconds_since(saved_) > k_seconds_between_saves) keep(true);
        }
        if (use_cache_ && rendered_) {
            keep(!result.complete);
            if (problem_.empty()) {
                if (result.complete) forget_partial_state(render_.key());
                prune_states(k_reference_cache_bytes, render_.key());
            }
        }
        result.kept_problem = problem_;
        result.image = render_.image();
        result.samples = render_.samples();
        result.noise = render_.noise(goal_.part).relative_off_edges();
        result.cached = !rendered_;
        return result;
    }

  private:
    bool by_noise() const { return goal_.samples == 0; }
    int limit() const { return by_noise() ? goal_.max_samples : goal_.samples; }
    bool at_checkpoint() const {
        const int n = render_.samples();
        return n > 0 && n == render_.max_samples() && reference_checkpoint(n - 1) == n;
    }
    int next_count() const { return std::min(limit(), reference_checkpoint(render_.samples())); }

    double measured_noise() const {
        if (render_.history().empty()) return 0;
        return render_.history().back().relative_noise.at(goal_.part);
    }
    static bool quiet_enough(const ReferenceRender::Checkpoint& checkpoint, const ReferenceGoal& goal) {
        return checkpoint.relative_noise.at(goal.part) <= goal.noise;
    }
    bool reached() const {
        if (render_.samples() >= limit() && render_.samples() == render_.max_samples()) return true;
        return by_noise() && at_checkpoint() && !render_.history().empty() &&
               render_.history().back().samples == render_.samples() && quiet_enough(render_.history().back(), goal_);
    }

    /// Takes up the most advanced kept state that a fresh run would have passed through on its way to the goal.
    void resume() {
        std::vector<KeptState> states = kept_states(render_.key());
        // A noise goal may have been reached by an earlier run on its way to a lower one: where, its history tells.
        int last = limit();
        if (by_noise()) {
            for (const KeptState& state : states) {
                const auto header = read_state_header(state.path);
                if (!header) continue;
                for (const auto& checkpoint : header->history) {
                    const auto noise = checkpoint.relative_noise.find(goal_.part);
                    if (noise != checkpoint.relative_noise.end() && noise->second <= goal_.noise) {
                        last = std::min(last, checkpoint.samples);
                        break;
                    }
                }
            }
        }
        for (auto state = states.rbegin(); state != states.rend(); ++state) {
            if (state->max_samples > last) continue;
            try {
                render_.load_state(state->path);
                if (at_checkpoint()) render_.add_checkpoint();
                return;
            } catch (const Error&) {
                // Damaged: render it anew.
            }
        }
    }

    void keep(bool partial) {
        saved_ = Clock::now();
        problem_.clear();
        try {
            keep_state(render_, partial);
        } catch (const std::exception& error) {
            problem_ = error.what();
        }
    }

    /// Renders in another thread while this one reports. Returns false when stopped.
    bool render_chunk(int count) {
        auto done = std::async(std::launch::async, [&] { return render_.render_to(count); });
        bool stop = false;
        while (done.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
            if (!stop && on_progress_ && !on_progress_(progress(count))) stop = true;
            if (stop) render_.cancel();
        }
        const bool finished = done.get();
        if (finished && !stop && on_progress_ && !on_progress_(progress(count))) stop = true;
        return finished && !(stop && render_.samples() < limit());
    }

    ReferenceProgress progress(int count) const {
        ReferenceProgress p;
        const double elapsed = seconds_since(began_);
        p.noise = measured_noise();
        double goal_samples = limit();
        if (by_noise() && p.noise > 0 && goal_.noise > 0) {
            // Noise falls with the root of the number of samples.
            const double ratio = p.noise / goal_.noise;
            goal_samples = std::min<double>(limit(), render_.history().back().samples * ratio * ratio);
        }
        const double before = chunk_start(count);
        const double now = before + (count - before) * render_.progress();
        p.samples = int(now);
        p.share = std::clamp(now / std::max(goal_samples, now), 0.0, 1.0);
        const double rate = (now - started_at_) / std::max(elapsed, 1e-6);
        const bool known = rate > 0 && (!by_noise() || p.noise > 0);
        if (known) p.seconds_left = std::max(0.0, goal_samples - now) / rate;
        p.rays_per_second = double(render_.rays()) / std::max(elapsed, 1e-6);
        return p;
    }
    /// The count at which the running chunk began: the last checkpoint before it.
    double chunk_start(int count) const {
        int previous = 0;
        for (int c = 0; c < count; c = reference_checkpoint(c))
            previous = c;
        return std::max<double>(previous, started_at_);
    }

    ReferenceRender& render_;
    const ReferenceGoal& goal_;
    const std::function<bool(const ReferenceProgress&)>& on_progress_;
    bool use_cache_;
    bool rendered_ = false;
    int started_at_ = 0;
    Clock::time_point began_ = Clock::now(), saved_ = Clock::now();
    std::string problem_;
};

} // namespace

int reference_checkpoint(int samples) {
    int power = 16;
    while (true) {
        if (power > samples) return power;
        if (power / 2 * 3 > samples) return power / 2 * 3;
        if (power > (1 << 28)) return 1 << 30;
        power *= 2;
    }
}

ReferenceResult reference_image(const Shot& shot, const ReferenceSettings& settings, int frame,
                                const ReferenceGoal& goal,
                                const std::function<bool(const ReferenceProgress&)>& on_progress, bool use_cache) {
    if (goal.samples < 0 || goal.noise < 0 || (goal.samples == 0) == !(goal.noise > 0) ||
        (goal.samples > 0 && goal.noise > 0)) {
        throw Error("a reference needs either a number of samples or a noise level, above 0");
    }
    if (goal.samples == 1)
        throw Error("a reference needs at least 2 samples a pixel: its noise is told from two halves");
    ReferenceRender render(shot, settings, frame);
    (void)render.half(goal.part, 0); // an unknown part is an error before the work, not after
    return GoalRun(render, goal, on_progress, use_cache).run();
}

} // namespace bounce
