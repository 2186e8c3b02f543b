#ifndef LIB_SAMPLER_GLSL
#define LIB_SAMPLER_GLSL
// The random numbers of one sample of one pixel: an Owen-scrambled, index-shuffled Sobol sequence over the samples of the
// pixel in each dimension (Burley 2020). passes/core/low_discrepancy.h mirrors this file.
#include "lib/hash.glsl"

struct PixelSampler {
    uint seed, index_reversed, dimension;
};

float unit_float(uint bits) {
    return float(bits >> 8) / 16777216.0;
}

uint owen_scramble_reversed(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Times the Pascal matrix mod 2.
uint pascal_bits(uint x) {
    x ^= x >> 16;
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xaaaaaaaau) >> 1;
    return x;
}

PixelSampler pixel_sampler(uint seed, uint index) {
    return PixelSampler(seed, bitfieldReverse(index), 0u);
}

// Jumps to dimensions of their own.
void start_block(inout PixelSampler s, uint block) {
    s.dimension = block << 10;
}

float next(inout PixelSampler s) {
    uint seed = hash_combine(s.seed, s.dimension++);
    uint shuffled = bitfieldReverse(owen_scramble_reversed(s.index_reversed, seed));
    return unit_float(bitfieldReverse(owen_scramble_reversed(shuffled, hash_u32(seed ^ 0x68bc21ebu))));
}

vec2 next_pair(inout PixelSampler s) {
    uint seed = hash_combine(s.seed, s.dimension++);
    uint shuffled = bitfieldReverse(owen_scramble_reversed(s.index_reversed, seed));
    uint x = owen_scramble_reversed(shuffled, hash_u32(seed ^ 0x68bc21ebu));
    uint y = owen_scramble_reversed(pascal_bits(shuffled), hash_u32(seed ^ 0x967a889bu));
    return vec2(unit_float(bitfieldReverse(x)), unit_float(bitfieldReverse(y)));
}

// A hash of the sample and of what was drawn so far, which draws nothing itself; never 0.
uint sampler_key(PixelSampler s, uint salt) {
    return hash_combine(hash_combine(hash_combine(s.seed, s.index_reversed), s.dimension), salt) | 1u;
}

#endif
