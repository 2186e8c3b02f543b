#include "core/low_discrepancy.h"

#include "core/error.h"

#include <array>

namespace bounce {

double radical_inverse(uint32_t base, uint64_t index) {
    double digit_weight = 1.0 / base;
    double value = 0;
    for (; index; index /= base, digit_weight /= base)
        value += double(index % base) * digit_weight;
    return value;
}

double halton(int dimension, uint64_t index) {
    static constexpr std::array<uint32_t, 16> k_primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
    if (dimension < 0 || dimension >= int(k_primes.size())) {
        throw Error("the Halton sequence has the dimensions 0 to 15 here, not " + std::to_string(dimension));
    }
    return radical_inverse(k_primes[size_t(dimension)], index);
}

uint32_t sobol_second(uint32_t index) {
    return reverse_bits(pascal_bits(index));
}

} // namespace bounce
