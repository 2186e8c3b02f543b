#ifndef LIB_HASH_GLSL
#define LIB_HASH_GLSL
// Hashes of whole numbers; passes/core/low_discrepancy.h mirrors them.

uint hash_u32(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}
uint hash_combine(uint a, uint b) {
    return hash_u32(a ^ (b + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

#endif
