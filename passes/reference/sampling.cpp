#include "reference/sampling.h"

#include <algorithm>

namespace bounce {

WeightedTable::WeightedTable(const std::vector<float>& weights) : sums_(weights.size()) {
    double sum = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] > 0 && std::isfinite(weights[i])) sum += weights[i];
        sums_[i] = sum;
    }
    if (!(sum > 0)) return;
    const size_t steps = std::clamp<size_t>(weights.size(), 1, 1u << 20);
    first_.resize(steps + 1);
    size_t entry = 0;
    for (size_t step = 0; step <= steps; ++step) {
        while (entry + 1 < sums_.size() && sums_[entry] <= sum * double(step) / double(steps))
            ++entry;
        first_[step] = uint32_t(entry);
    }
}

size_t WeightedTable::draw(float& u) const {
    const double target = double(u) * total();
    const size_t steps = first_.size() - 1;
    const size_t step = std::min(steps - 1, size_t(double(u) * double(steps)));
    // One entry of slack on either side, for the rounding of the table.
    const size_t from = first_[step] > 0 ? first_[step] - 1 : 0;
    const size_t to = std::min(sums_.size(), size_t(first_[step + 1]) + 2);
    size_t i = size_t(std::upper_bound(sums_.begin() + ptrdiff_t(from), sums_.begin() + ptrdiff_t(to), target) -
                      sums_.begin());
    i = std::min(i, sums_.size() - 1);
    // Rounding must not pick an entry without weight.
    while (i > 0 && sums_[i] == sums_[i - 1])
        --i;
    const double before = i ? sums_[i - 1] : 0;
    u = float(std::clamp((target - before) / (sums_[i] - before), 0.0, 0x1.fffffep-1));
    return i;
}

} // namespace bounce
