#pragma once
// Low-discrepancy sequences and the integer hashes that seed them. All are pure functions of their arguments, so the
// same sample is drawn whatever thread asks for it.

#include <cstdint>
#include <glm/glm.hpp>

namespace bounce {

/// A well mixed hash (Wellons' "lowbias32").
inline uint32_t hash_u32(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}
inline uint32_t hash_combine(uint32_t a, uint32_t b) {
    return hash_u32(a ^ (b + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

/// The top 24 bits as a float in [0, 1).
inline float unit_float(uint32_t bits) {
    return float(bits >> 8) * 0x1p-24f;
}

inline uint32_t reverse_bits(uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// The digits of `index` in `base`, mirrored at the radix point: in [0, 1).
double radical_inverse(uint32_t base, uint64_t index);
/// Point `index` of the Halton sequence; `dimension` 0 … 15 picks the prime base. Throws Error beyond.
double halton(int dimension, uint64_t index);

/// The first two dimensions of the Sobol sequence, as 32-bit fractions: together a (0,2)-sequence in base 2.
inline uint32_t sobol_first(uint32_t index) {
    return reverse_bits(index);
}
uint32_t sobol_second(uint32_t index);

/// Owen's nested uniform scramble of a 32-bit fraction, by a hash that only carries upward (Laine & Karras 2011, with
/// the constants of Vegdahl 2021).
inline uint32_t owen_scramble_reversed(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
inline uint32_t owen_scramble(uint32_t fraction, uint32_t seed) {
    return reverse_bits(owen_scramble_reversed(reverse_bits(fraction), seed));
}

/// The random numbers of one sample of one pixel, drawn in a fixed order. Each draw is a dimension (or pair) of its
/// own: an Owen-scrambled, index-shuffled Sobol sequence over the samples of the pixel (Burley 2020, "Practical
/// hash-based Owen scrambling"), so samples 0 … 2^k − 1 are stratified in each. Pixels (seeds) are independent. With
/// `stratified` off, plain hashed random numbers.
class PixelSampler {
  public:
    PixelSampler(uint32_t seed, uint32_t sample, bool stratified)
        : seed_(seed), index_reversed_(reverse_bits(sample)), stratified_(stratified) {}

    float next() {
        uint32_t dimension_seed = next_dimension();
        if (!stratified_) return unit_float(hash_combine(dimension_seed, index_reversed_));
        uint32_t shuffled = reverse_bits(owen_scramble_reversed(index_reversed_, dimension_seed));
        return unit_float(reverse_bits(owen_scramble_reversed(shuffled, hash_u32(dimension_seed ^ 0x68bc21ebu))));
    }
    glm::vec2 next_pair();
    /// Jumps to the dimensions of block `block`, so that what was drawn before has no influence on what follows.
    void start_block(uint32_t block) { dimension_ = block << 10; }

    /// A hash of the sample and of what was drawn so far, which draws nothing itself; never 0.
    uint32_t key(uint32_t salt) const {
        return hash_combine(hash_combine(hash_combine(seed_, index_reversed_), dimension_), salt) | 1u;
    }

  private:
    uint32_t next_dimension() { return hash_combine(seed_, dimension_++); }

    uint32_t seed_;
    uint32_t index_reversed_;
    uint32_t dimension_ = 0;
    bool stratified_;
};

/// Multiplies the bits of x by the Pascal matrix mod 2, which takes sobol_first to sobol_second before the mirroring.
inline uint32_t pascal_bits(uint32_t x) {
    x ^= (x >> 16);
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xaaaaaaaau) >> 1;
    return x;
}

inline glm::vec2 PixelSampler::next_pair() {
    uint32_t dimension_seed = next_dimension();
    if (!stratified_) {
        uint32_t first = hash_combine(dimension_seed, index_reversed_);
        return {unit_float(first), unit_float(hash_u32(first ^ 0x02e5be93u))};
    }
    uint32_t shuffled = reverse_bits(owen_scramble_reversed(index_reversed_, dimension_seed));
    uint32_t x = owen_scramble_reversed(shuffled, hash_u32(dimension_seed ^ 0x68bc21ebu));
    uint32_t y = owen_scramble_reversed(pascal_bits(shuffled), hash_u32(dimension_seed ^ 0x967a889bu));
    return {unit_float(reverse_bits(x)), unit_float(reverse_bits(y))};
}

} // namespace bounce
