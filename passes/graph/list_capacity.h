#pragma once
// The capacity of a list that a pass fills before its length is known: it starts from an estimate, counts what it
// drops, and is planned again with more.

#include <cmath>
#include <cstdint>
#include <vector>

namespace bounce {

class ListCapacity {
  public:
    /// For Pass::needs_larger_buffers. `counted` begins with the entries that the fullest batch had and those that were
    /// dropped; `held`: how many the list holds now, where that is not entries(). True: it shall hold entries() from
    /// here on, a tenth more than were asked for.
    bool needs_larger(const std::vector<int64_t>& counted, int64_t held = 0) {
        if (counted.size() < 2 || counted[1] <= 0 || counted[0] <= (held > 0 ? held : entries_)) return false;
        entries_ = int64_t(std::ceil(1.1 * double(counted[0])));
        return true;
    }
    void reset() { entries_ = 0; }
    /// 0: nothing was dropped yet, so that the estimate stands.
    int64_t entries() const { return entries_; }

  private:
    int64_t entries_ = 0;
};

} // namespace bounce
