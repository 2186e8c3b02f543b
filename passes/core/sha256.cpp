#include "core/sha256.h"

#include <array>
#include <bit>
#include <cstdint>

namespace bounce {

namespace {

using Words = std::array<uint32_t, 64>;

/// The first 32 bits of the fractional parts of the cube roots of the first 64 primes (4.2.2), to be had without a
/// table: the root of a prime below 312 is below 7, so an integer search of 35 bits finds it.
Words round_constants() {
    Words constants{};
    size_t found = 0;
    for (uint32_t n = 2; found < constants.size(); ++n) {
        bool prime = true;
        for (uint32_t d = 2; d * d <= n; ++d)
            prime = prime && n % d != 0;
        if (!prime) continue;
        // The largest r with r³ <= n · 2^96.
        uint64_t root = 0;
        for (int bit = 34; bit >= 0; --bit) {
            const unsigned __int128 next = root | uint64_t(1) << bit;
            if (next * next * next <= static_cast<unsigned __int128>(n) << 96) root = uint64_t(next);
        }
        constants[found++] = uint32_t(root);
    }
    return constants;
}

void add_block(std::array<uint32_t, 8>& state, const unsigned char* block) {
    static const Words k = round_constants();
    Words w{};
    for (size_t i = 0; i < 16; ++i)
        w[i] = uint32_t(block[4 * i]) << 24 | uint32_t(block[4 * i + 1]) << 16 | uint32_t(block[4 * i + 2]) << 8 |
               uint32_t(block[4 * i + 3]);
    for (size_t i = 16; i < 64; ++i) {
        const uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
        const uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
        w[i] = w[i - 16] + s0 + w[i - 7] + s1;
    }
    auto [a, b, c, d, e, f, g, h] = state;
    for (size_t i = 0; i < 64; ++i) {
        const uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
        const uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + k[i] + w[i];
        const uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
        const uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + t1;
        d = c;
        c = b;
        b = a;
        a = t1 + t2;
    }
    const std::array<uint32_t, 8> added = {a, b, c, d, e, f, g, h};
    for (size_t i = 0; i < 8; ++i)
        state[i] += added[i];
}

} // namespace

std::string sha256(std::string_view bytes) {
    // The square roots of the first eight primes, likewise (5.3.3).
    std::array<uint32_t, 8> state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                     0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::string padded(bytes);
    padded += '\x80';
    padded.resize((padded.size() + 8 + 63) / 64 * 64 - 8, '\0');
    for (int shift = 56; shift >= 0; shift -= 8)
        padded += char(uint64_t(bytes.size()) * 8 >> shift & 0xff);
    for (size_t at = 0; at < padded.size(); at += 64)
        add_block(state, reinterpret_cast<const unsigned char*>(padded.data()) + at);
    std::string digest;
    for (uint32_t word : state)
        for (int shift = 24; shift >= 0; shift -= 8)
            digest += char(word >> shift & 0xff);
    return digest;
}

} // namespace bounce
