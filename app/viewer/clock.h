#pragma once
// Time of the window's loop.

#include <chrono>

namespace bounce {

/// Seconds from some moment on.
inline double seconds_now() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// A frame of more milliseconds is slow: it is cut between its passes, and coarse while something moves.
inline constexpr float k_slow_frame_ms = 100;

} // namespace bounce
