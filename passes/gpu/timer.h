#pragma once
// GPU time of a stretch of commands, without ever stalling where the driver's queries can be trusted.

#include <array>
#include <glad/gl.h>
#include <optional>

namespace bounce {

enum class TimerMode {
    queries, ///< a ring of timestamp queries, read when they are ready
    finish   ///< glFinish and the CPU's clock: for drivers whose queries read 0 around compute (llvmpipe)
};
/// Times a small dispatch both ways. Needs a current context.
TimerMode probe_timer_mode();
const char* to_string(TimerMode mode);

class GpuTimer {
  public:
    explicit GpuTimer(TimerMode mode) : mode_(mode) {}
    ~GpuTimer();
    GpuTimer(GpuTimer&& other) noexcept;
    GpuTimer& operator=(GpuTimer&&) = delete;

    /// False when the ring is full: this stretch is not measured rather than waited for.
    bool begin();
    void end();
    /// Milliseconds of the newest finished measurement that was not yet taken; empty when none is ready.
    std::optional<double> take();

  private:
    static constexpr int k_ring = 4;
    struct Pair {
        GLuint begin = 0, end = 0;
        bool pending = false;
    };
    TimerMode mode_;
    std::array<Pair, k_ring> ring_;
    int head_ = 0;
    bool recording_ = false;
    double started_ = 0;
    std::optional<double> ready_;
};

/// Seconds of a steady clock.
double steady_seconds();

} // namespace bounce
