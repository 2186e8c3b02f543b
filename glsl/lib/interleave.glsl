#ifndef LIB_INTERLEAVE_GLSL
#define LIB_INTERLEAVE_GLSL
// Interleaved sampling (Keller & Heidrich 2001; Segovia et al. 2006): neighbours in blocks of n × n take different sets of
// directions, and a filter as wide as a block later sees every set once.

// Which of n·n sets a texel takes, as a part in [0, 1); n = 1: ½. The order is that of a Bayer matrix for n = 2 and 4.
float interleaved_part(ivec2 texel, int n) {
    if (n <= 1) return 0.5;
    ivec2 p = texel % n;
    int order = p.x + n * p.y;
    if (n == 2) order = (p.x ^ p.y) * 2 + p.y;
    if (n == 4) order = (((p.x ^ p.y) & 1) * 2 + (p.y & 1)) * 4 + ((p.x ^ p.y) >> 1) * 2 + (p.y >> 1);
    return (float(order) + 0.5) / float(n * n);
}

#endif
