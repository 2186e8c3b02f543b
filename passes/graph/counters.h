#pragma once
// Counters that passes keep on the GPU (overflow, list lengths, layers in use), read back without a stall: each frame
// copies them aside behind a fence, and a later frame takes what has arrived.

#include "gpu/objects.h"
#include "graph/allocations.h"

#include <cstdint>
#include <deque>
#include <glad/gl.h>
#include <string>
#include <vector>

namespace bounce {

struct CounterValue {
    std::string pass;  ///< id
    std::string label; ///< "layers stored"
    int64_t value = 0;
    bool overflow = false; ///< above 0 it tells that something was left out
    bool bad() const { return overflow && value > 0; }
};

class Counters {
  public:
    Counters() = default;
    ~Counters() { drop(); }
    Counters(const Counters&) = delete;
    Counters& operator=(const Counters&) = delete;

    /// Copies the counters of `plan` aside, after the passes of a frame. Takes those of earlier frames that are done.
    /// Returns true when `newest` changed.
    bool collect(const Plan& plan, const Allocations& allocations);
    /// Waits for the newest (headless runs, before they report). Returns true when `newest` changed.
    bool finish();
    /// Forgets what was counted, and what is on its way.
    void drop();
    const std::vector<CounterValue>& newest() const { return newest_; }

  private:
    struct Pending {
        Buffer copy;
        GLsync fence = nullptr;
        std::vector<CounterValue> values; ///< without the numbers
    };
    bool take(GLuint64 wait);

    std::deque<Pending> pending_;
    std::vector<Buffer> spare_;
    std::vector<CounterValue> newest_;
};

} // namespace bounce
